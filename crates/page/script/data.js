// Data of this page.

const page = JSON.parse(document.getElementById('data').textContent);
/** Names of layers; the digit keys show and hide the layers of a plan in order. */
const LAYERS = { predicted: 'predicted', planar: '2-D', spatial: '3-D', seen: 'observed', real: 'true' };

/** All goals; a recording has none. */
const { goals } = page.stage;
/** Returns the object of which this one is a part, or its own index. */
const whole = (object) => page.stage.objects[object]?.whole ?? object;
const wants = (object) => goals.some((goal) => goal.objects.includes(whole(object)));
