

# Travel of lifted tools. Objects stand still meanwhile, so that only distances are checked.

STRIDE = 5e-3  # largest distance between two checks, m
STEP = 0.05  # largest rotation between two checks, rad
TOUCH = -1e-4  # distance below which two bodies overlap, m
ON_THE_WAY = "collides on the way"


def travel(scene, step):
    """Moves the lifted tools along the legs that lead to a step, counted from 1."""
    legs = {name[4:]: leg for name, leg in scene.numbers.items() if name.startswith("leg ")}
    for number, leg in legs.items():
        if int(leg[0]) != step:
            continue
        height, turned = scene.numbers["travel"][0], scene.numbers["travel"][1]
        scene.take(int(leg[1]) - 1)
        heading = [leg[2]] if turned else []
        corners = [np.append(corner, heading) for corner in leg[5:].reshape(-1, 2)]
        lifted = [height * share for share in np.linspace(0.0, 1.0, math.ceil(height / STRIDE) + 1)]
        first = scene.numbers.get(f"turn {number}", corners[0])
        if leg[3]:  # from the end of a step, where the tool has been lifted a little
            for h in lifted[1:]:
                clear(scene, first, h)
            for place in rotation(first, corners[0]):
                clear(scene, place, height)
        for a, b in zip(corners, corners[1:]):
            for share in np.linspace(0.0, 1.0, math.ceil(math.dist(a, b) / STRIDE) + 1):
                clear(scene, a + (b - a) * share, height)
        if leg[4]:  # to the start of a step
            for h in lifted[::-1]:
                clear(scene, corners[-1], h, "set down on an object")


def rotation(first, last):
    """Yields poses during a rotation about the end effector, which does not move."""
    turn = math.remainder(last[-1] - first[-1], math.tau) if len(last) == 3 else 0.0
    if turn == 0.0:
        return
    matrix = lambda angle: np.array(
        [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    )
    change = matrix(last[2]) - matrix(first[2])
    grip = np.linalg.solve(change, last[:2] - first[:2])
    centre = first[:2] - matrix(first[2]) @ grip
    for share in np.linspace(0.0, 1.0, math.ceil(abs(turn) / STEP) + 1):
        heading = first[2] + share * turn
        yield np.append(centre + matrix(heading) @ grip, heading)


def clear(scene, place, height, failure=ON_THE_WAY):
    """Fails if the current tool with its hand overlaps a body at a place."""
    scene.place(place, 0.0, height)
    mujoco.mj_kinematics(scene.model, scene.data)
    met(scene, failure)


def met(scene, failure, hand=False):
    """Fails if the current tool with its hand, or the hand alone, overlaps a body."""
    model, data = scene.model, scene.data
    for own in scene.tool_geoms:
        if hand and not model.geom(own).name.endswith("/hand"):
            continue
        for other in scene.others:
            reach = model.geom_rbound[own] + model.geom_rbound[other]
            if math.dist(data.geom_xpos[own], data.geom_xpos[other]) > reach:
                continue
            if mujoco.mj_geomDistance(model, data, own, other, 1.0, None) < TOUCH:
                raise Failed(failure)
