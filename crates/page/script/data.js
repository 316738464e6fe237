// Data of this page.

const page = JSON.parse(document.getElementById('data').textContent);
/** Names of layers; the digit keys show and hide the layers of a plan in order. */
const LAYERS = { predicted: 'predicted', planar: '2-D', spatial: '3-D', seen: 'observed', real: 'true' };

/** All goals; a recording has none. */
const { goals } = page.stage;
const wants = (object) => goals.some((goal) => goal.objects.includes(object));
