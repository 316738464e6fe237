// The parts of three.js that `crates/page/script/solid.js` uses.
export {
  BufferGeometry, CircleGeometry, Color, CylinderGeometry, DirectionalLight, EdgesGeometry, ExtrudeGeometry,
  Group, HemisphereLight, Line, LineBasicMaterial, LineLoop, LineSegments, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, PerspectiveCamera, PlaneGeometry, Scene, Shape, Vector2, Vector3, WebGLRenderer,
} from 'three';
export { OrbitControls } from 'three/addons/controls/OrbitControls.js';
