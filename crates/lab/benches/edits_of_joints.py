"""Wrong edits of joint trajectories and of the arm, for `edited.py`."""


def on_joints(change):
    """Returns an edit of the joint trajectory, given its points and its first push."""

    def edit(file, step):
        joints = file.get("joints")
        return False if not joints else change(joints, joints["points"], joints["pushes"][0])

    return edit


def on_arm(change):
    """Returns an edit of the arm, given the points of its trajectory."""

    def edit(file, step):
        if not file.get("joints"):
            return False
        return change(file["task"]["robot"]["arm"], file["joints"]["points"])

    return edit


def elsewhere(joints, points, push):
    points[0]["positions"][1] += 0.2


def all_turned(joints, points, push):
    for point in points:
        point["positions"][0] += 0.05


def a_little_off(joints, points, push):
    points[sum(push) // 2]["positions"][0] += 0.01


def stretched(share, first=False):
    def edit(joints, points, push):
        """Stretches all times, or the time of the first push alone."""
        times = [point["time"] for point in points]
        for k in range(1, len(points)):
            span = times[k] - times[k - 1]
            span *= share if not first or push[0] < k <= push[1] else 1.0
            points[k]["time"] = points[k - 1]["time"] + span
        for k, point in enumerate(points):
            if not first or push[0] < k < push[1]:
                point["velocities"] = [v / share for v in point["velocities"]]

    return edit


def jump(joints, points, push):
    """Makes the farthest motion between two points in a millisecond."""
    far = [
        max(abs(a - b) for a, b in zip(one["positions"], next["positions"]))
        for one, next in zip(points, points[1:])
    ]
    at = far.index(max(far))
    saved = points[at + 1]["time"] - points[at]["time"] - 0.001
    for point in points[at + 1 :]:
        point["time"] -= saved


def cut(joints, points, push):
    """Leaves out the points within the first push."""
    begin, last = push
    del points[begin + 1 : last]
    joints["pushes"] = [
        [k if k <= begin else k - (last - begin - 1) for k in one] for one in joints["pushes"]
    ]


def halved(joints, points, push):
    """Ends in the middle of the last push."""
    last = joints["pushes"][-1]
    last[1] = sum(last) // 2
    del points[last[1] + 1 :]
    points[-1]["velocities"] = [0.0] * len(joints["joints"])


def moving(at):
    def edit(joints, points, push):
        points[at]["velocities"][0] = 0.3

    return edit


def whirling(joints, points, push):
    at = points[sum(push) // 2]
    at["velocities"] = [v + 100.0 for v in at["velocities"]]


def stopping(joints, points, push):
    for point in points[push[0] : push[1]]:
        point["velocities"] = [0.0] * len(point["velocities"])


def late(joints, points, push):
    for point in points:
        point["time"] += 1.0


def swapped(joints, points, push):
    joints["joints"][:2] = joints["joints"][1::-1]


def early(joints, points, push):
    push[0] += 1


def limits(arm, points):
    """Narrows a joint's limits to less than its motion."""
    for joint, positions in zip(arm["joints"], zip(*(point["positions"] for point in points))):
        room = max(positions) - positions[0]
        if room > 0.02:
            joint["limits"] = [min(positions) - 1.0, positions[0] + 0.5 * room]
            return True
    return False


def weak_joints(arm, points):
    for joint in arm["joints"]:
        joint["max_speed"] = 0.01


def moved_base(arm, points):
    arm["base"]["position"][0] += 0.01


def mount(arm, points):
    arm["mount"]["length"] += 0.01


def home(arm, points):
    arm["home"][0] += 0.1


JOINTS = {
    "elsewhere": on_joints(elsewhere), "all-turned": on_joints(all_turned),
    "a-little-off": on_joints(a_little_off), "jump": on_joints(jump), "cut": on_joints(cut),
    "all-fast": on_joints(stretched(0.5)), "all-slow": on_joints(stretched(2.0)),
    "push-fast": on_joints(stretched(0.9, first=True)),
    "push-slow": on_joints(stretched(1.5, first=True)),
    "halved": on_joints(halved), "moving-at-first": on_joints(moving(0)),
    "moving-at-last": on_joints(moving(-1)), "whirling": on_joints(whirling),
    "stopping": on_joints(stopping), "late": on_joints(late), "swapped": on_joints(swapped),
    "early": on_joints(early), "limits": on_arm(limits), "weak-joints": on_arm(weak_joints),
    "moved-base": on_arm(moved_base), "mount": on_arm(mount), "home": on_arm(home),
}
