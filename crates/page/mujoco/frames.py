#!/usr/bin/env python3
"""Replays motions exported by pushplan in MuJoCo and reports the poses of all objects, frame by
frame.

Reads one line of JSON for each motion from stdin: {"scene": MJCF, "frames": [n, ...]}, where n is
the number of frames of a push. Writes one line for each to stdout: {"frames": [...]}, or {"failed":
reason}. A frame has `time`, `stroke` and, for each of the `objects` in the order of the scene, x,
y, heading and their velocities. The first line of stdout is the version of MuJoCo. `replay.py` must
be in the same folder. Units are metres, seconds and radians.
"""

import json
import math
import sys

import mujoco
import numpy as np
from replay import Failed, Replay

class Film(Replay):
    """One scene whose frames are recorded."""

    def __init__(self, model):
        super().__init__(model)
        self.time = 0.0
        self.headings = None
        self.frames = []

    def play(self, counts):
        """Executes all pushes, each with its number of frames."""
        lifted = True
        for stroke, (push, count) in enumerate(zip(self.pushes, counts, strict=True)):
            start, end, duration, settle = push[0:2], push[2:4], push[4], push[5]
            if len(push) > 6:  # it rotates
                start, end = np.append(start, push[6]), np.append(end, push[7])
            if lifted:
                self.set_down(start)
            if not self.frames:
                self.keep(stroke)
            # No step is longer than the scene's, and every frame ends with a step.
            steps = math.ceil(duration / count / self.step - 1e-9)
            self.model.opt.timestep = duration / count / steps
            for k in range(count * steps):
                share = k / (count * steps)
                self.move(start + (end - start) * share, (end - start) / duration)
                if (k + 1) % steps == 0:
                    self.time += duration / count
                    self.keep(stroke)
            if settle:
                self.wait(stroke, end)
            lifted = settle

    def wait(self, stroke, place):
        """Holds the tool still until everything rests."""
        speed, every, most = self.numbers["rest"]
        self.model.opt.timestep = self.step
        waited = 0
        while not self.is_resting(speed):
            if waited == most:
                raise Failed("never rests")
            for _ in range(round(every / self.step)):
                self.move(place, 0.0)
            waited += 1
            self.time += every
            self.keep(stroke)

    def keep(self, stroke):
        """Records the poses and velocities of all objects."""
        # The last step moved the bodies, but did not update the derived quantities.
        mujoco.mj_forward(self.model, self.data)
        poses = np.array([self.pose(body) for body in self.bodies])
        if self.headings is not None:
            # Unwrapped, without jumps by full turns.
            turned = np.remainder(poses[:, 2] - self.headings + math.pi, math.tau) - math.pi
            poses[:, 2] = self.headings + turned
        self.headings = poses[:, 2].copy()
        objects = []
        for body, pose in zip(self.bodies, poses):
            velocity, kind = np.zeros(6), mujoco.mjtObj.mjOBJ_BODY
            mujoco.mj_objectVelocity(self.model, self.data, kind, body, velocity, 0)
            objects.append([*pose.tolist(), velocity[3], velocity[4], velocity[2]])
        self.frames.append({"time": self.time, "stroke": stroke, "objects": objects})


def film(request):
    """Returns the frames of one motion."""
    scene = Film(mujoco.MjModel.from_xml_string(request["scene"]))
    try:
        scene.play(request["frames"])
    except Failed as failed:
        return {"failed": str(failed)}
    return {"frames": scene.frames}


def main():
    print(json.dumps(mujoco.__version__), flush=True)
    for line in sys.stdin:
        print(json.dumps(film(json.loads(line))), flush=True)


if __name__ == "__main__":
    main()
