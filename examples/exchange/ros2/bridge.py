"""A bridge between `nivel live` and ROS 2: a topic sets the inputs, another one has the gauges. See README.md."""

import socket
import struct
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Float64MultiArray

HEADER = struct.Struct("<4sHHIIq")  # as docs/live.md describes it
VERSION = 1


class Bridge(Node):
    """Datagrams of `nivel live` on one side, topics on the other."""

    def __init__(self):
        super().__init__("nivel")
        self.declare_parameter("to", "127.0.0.1:5005")
        self.declare_parameter("at", "127.0.0.1:5006")
        self.to, at = (self._address(name) for name in ("to", "at"))
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(at)
        self.socket.setblocking(False)
        self.number, self.values = 0, None
        self.gauges = self.create_publisher(Float64MultiArray, "~/gauges", 10)
        self.create_subscription(Float64MultiArray, "~/inputs", self._inputs, 10)
        self.create_timer(0.01, self._exchange)

    def _address(self, name):
        host, _, port = self.get_parameter(name).value.rpartition(":")
        return host, int(port)

    def _inputs(self, message):
        self.values = list(message.data)

    def _exchange(self):
        """Send the last inputs, which `nivel live` forgets after half a second, and publish what has come."""
        if self.values is not None:
            self.number += 1
            head = HEADER.pack(b"NVLI", VERSION, len(self.values), self.number, 0, time.monotonic_ns())
            self.socket.sendto(head + struct.pack(f"<{len(self.values)}d", *self.values), self.to)
        while True:
            try:
                content = self.socket.recv(4096)
            except BlockingIOError:
                return
            mark, version, count, *_ = HEADER.unpack_from(content)
            if mark == b"NVLO" and version == VERSION:
                self.gauges.publish(Float64MultiArray(data=struct.unpack_from(f"<{count}d", content, HEADER.size)))


def main():
    rclpy.init()
    rclpy.spin(Bridge())


if __name__ == "__main__":
    main()
