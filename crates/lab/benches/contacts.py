"""Contact pairs of an exported MuJoCo scene, used by `meshes.py` and `own_meshes.py`."""

import copy


def transfer(contact, ours, names):
    """Replaces the pairs of the geoms `ours` by pairs of the geoms `names` with the same bodies."""
    known = set()
    for pair in list(contact):
        ends = {pair.get("geom1"), pair.get("geom2")}
        if not ours & ends:
            continue
        contact.remove(pair)
        # Parts of an object do not collide; all of them collide alike with another body.
        for other in ends - ours - known:
            known.add(other)
            for own in names:
                added = copy.deepcopy(pair)
                added.set("geom1", own)
                added.set("geom2", other)
                contact.append(added)
