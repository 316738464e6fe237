// Names of bodies over the 3-D view.

/** Returns a layer of names over a canvas: `add` names a node, and `show` moves all names to their nodes. */
function namesOver(canvas) {
  const layer = html('div', { class: 'names', 'aria-hidden': 'true' });
  let all = [];
  return {
    layer,
    clear() {
      layer.replaceChildren();
      all = [];
    },
    /** Names a node at a height above its origin, metres. */
    add(node, text, height) {
      const own = html('span', {}, text);
      layer.append(own);
      all.push({ own, node, height });
    },
    show(camera) {
      const [width, height] = [canvas.clientWidth, canvas.clientHeight];
      for (const { own, node, height: above } of all) {
        const { x, y, z } = node.localToWorld(new THREE.Vector3(0, 0, above)).project(camera);
        own.hidden = !node.visible || node.parent?.visible === false || Math.abs(x) > 1 || Math.abs(y) > 1 || z > 1;
        own.style.left = `${((x + 1) / 2) * width}px`;
        own.style.top = `${((1 - y) / 2) * height}px`;
      }
    },
  };
}

