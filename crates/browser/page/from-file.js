// Opened as a file, the page cannot load the planner, because browsers start no modules and workers from files.

if (location.protocol === 'file:') {
  const folder = decodeURIComponent(location.pathname.replace(/\/[^/]*$/, '')) || '.';
  byId('trouble').textContent = 'Browsers do not run the planner in a page that is opened as a file. '
    + `Serve the folder with: python3 -m http.server --directory "${folder}" 8000. Then open http://localhost:8000.`;
  byId('trouble').hidden = false;
  byId('foot').textContent = '';
}
