

# Travel of lifted tools. Objects stand still meanwhile, so that only distances are checked.

STRIDE = 5e-3  # largest distance between two checks, m
TOUCH = -1e-4  # distance below which two bodies overlap, m
ON_THE_WAY = "collides on the way"


def travel(scene, step):
    """Moves the lifted tools along the legs that lead to a step, counted from 1."""
    legs = [leg for name, leg in scene.numbers.items() if name.startswith("leg ")]
    for leg in legs:
        if int(leg[0]) != step:
            continue
        height, turned = scene.numbers["travel"][0], scene.numbers["travel"][1]
        scene.take(int(leg[1]) - 1)
        heading = [leg[2]] if turned else []
        corners = [np.append(corner, heading) for corner in leg[5:].reshape(-1, 2)]
        lifted = [height * share for share in np.linspace(0.0, 1.0, math.ceil(height / STRIDE) + 1)]
        if leg[3]:  # from the end of a step, where the tool has been lifted a little
            for h in lifted[1:]:
                clear(scene, corners[0], h)
        for a, b in zip(corners, corners[1:]):
            for share in np.linspace(0.0, 1.0, math.ceil(math.dist(a, b) / STRIDE) + 1):
                clear(scene, a + (b - a) * share, height)
        if leg[4]:  # to the start of a step
            for h in lifted[::-1]:
                clear(scene, corners[-1], h, "set down on an object")


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
