"""Live operation: the solver in a process of its own, in real time; its operator and watchers in browsers; recordings and replays."""
