// Data of this page.

const page = JSON.parse(document.getElementById('data').textContent);
/** Names of layers; the digit keys show and hide the layers of a plan in order. */
const LAYERS = { predicted: 'predicted', planar: '2-D', spatial: '3-D', seen: 'observed', real: 'true' };

/** All goals; a recording has none. */
const { goals } = page.stage;
/** Returns the object of which this one is a part, or its own index. */
const whole = (object) => page.stage.objects[object]?.whole ?? object;
const wants = (object) => goals.some((goal) => goal.objects.includes(whole(object)));

/** Whether the first goal is a heading and nothing else, so that its error is an angle. */
const angular = !page.measure && goals.slice(0, 1).some(({ unplaced, heading, tolerance, areas, bands, covers, edges }) => (
  unplaced && heading && !tolerance && !areas.length && !bands && !covers && !edges));
/** Name of the error over time. */
const measured = page.measure?.name ?? (angular ? 'Heading error' : 'Goal error');
/** Formats an error in metres, or an angle in thousandths of a degree. */
const errorWords = (error) => (angular ? `${fixed(error * 1000, 1)}°` : millimetres(error));
/** Returns the largest error that the first goal allows. */
const allowedError = () => (angular ? ((goals[0].heading[1] * FINE * 180) / Math.PI) * 1e-3 : goals[0].tolerance * LENGTH);

