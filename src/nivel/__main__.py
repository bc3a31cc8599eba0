"""`python -m nivel`: the command line."""

from nivel.cli import main

if __name__ == "__main__":
    main()
