"""Touches buttons with a robot and a stick (`StickButton2D`). No object is pushed: the stick is an
extension of the robot, and reach alone decides which places touch a button.
"""

import numpy as np
from _kinder import Episode

#: Steps of the robot: change of x and y, of the heading, and of the arm.
STEP, TURN, REACH = 0.05, np.pi / 16, 0.1
#: Size of the world, and the edge of the table, which the robot's base does not cross.
WIDE, HIGH, EDGE = 3.5, 2.5, 1.25
#: Distance of the base from walls, of the gripper from the stick below it, and of the taken stick.
WALL, BELOW, TAKEN = 0.005, 0.05, 0.013


class StickGame(Episode):
    """Episode of `StickButton2D`."""

    def __init__(self, variant: str, seed: int, steps: int) -> None:
        super().__init__(f"kinder/StickButton2D-{variant}-v0", seed, steps)
        self.pushes, self.seconds, self.vacuum = 0, 0.0, 0.0
        self.low = self.state["robot"]["base_radius"] + WALL

    def go(self, x: float, y: float) -> None:
        """Moves the base to a place, with arm stretched towards the table."""
        while not self.over:
            robot = self.state["robot"]
            turn = np.angle(np.exp(1j * (np.pi / 2 - robot["theta"])))
            rest = np.array([x - robot["x"], y - robot["y"], turn, 0.2 - robot["arm_joint"]])
            far = float(np.max(np.abs(rest) / [STEP, STEP, TURN, REACH]))
            if far < 1e-3:
                return
            before = self.state["robot"]
            self.act([*(rest / max(far, 1.0)), self.vacuum])
            if self.state["robot"] == before:
                # A step into a wall or the stick changes nothing.
                return

    def play(self) -> None:
        """Takes the stick at its lower end, and touches the buttons from left to right."""
        robot, stick = self.state["robot"], self.state["stick"]
        middle, reach = stick["x"] + stick["width"] / 2, robot["arm_length"]
        foot = stick["y"] - reach - TAKEN
        self.go(robot["x"], min(robot["y"], foot - BELOW))
        self.go(float(np.clip(middle, self.low, WIDE - self.low)), foot - BELOW)
        self.go(float(np.clip(middle, self.low, WIDE - self.low)), foot)
        # The vacuum holds objects that it touched before the step.
        self.vacuum = 1.0
        self.act([0.0, 0.0, 0.0, 0.0, self.vacuum])
        top = stick["height"] + reach + TAKEN
        while not self.over:
            left = [
                (thing["x"], thing["y"])
                for name, thing in self.state.items()
                if name.startswith("button") and thing["color_g"] < 0.5
            ]
            if not left:
                return
            # The nearest one first.
            x, y = min(left, key=lambda place: abs(place[0] - self.state["robot"]["x"]))
            before = self.steps
            highest = min(EDGE - self.low, HIGH - WALL - top)
            up = float(np.clip(y - top + 0.1, self.low, highest))
            self.go(float(np.clip(x, self.low, WIDE - self.low)), up)
            if self.steps == before:
                return
