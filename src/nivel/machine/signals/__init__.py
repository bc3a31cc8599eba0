"""Sensors, states, events and inputs."""
