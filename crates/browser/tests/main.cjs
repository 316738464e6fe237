// Tests of the page in a real browser: `node main.cjs FOLDER [tasks|page]`.
//
// `tasks` compares every shipped task with the command in PUSHPLAN: plans, answers and times.
// `page` operates the page like a user. The default is both.

const fs = require('node:fs');
const http = require('node:http');
const path = require('node:path');
const { chromium } = require('playwright-core');

const { tasks } = require('./tasks.cjs');
const { usedAsPeopleDo } = require('./use.cjs');

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css' };

/** Serves a folder as a minimal server; `sent` is the number of bytes sent. */
function serve(folder) {
  const server = http.createServer((request, response) => {
    const name = path.normalize(decodeURIComponent(request.url.split('?')[0])).replace(/\/$/, '/index.html');
    const file = path.join(folder, name);
    if (!file.startsWith(folder) || !fs.existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'Content-Type': TYPES[path.extname(file)] ?? 'application/octet-stream' });
    response.end(fs.readFileSync(file));
  });
  return new Promise((resolve) => { server.listen(0, '127.0.0.1', () => resolve(server)); });
}

async function main([folder, what = 'all', ...words]) {
  const server = await serve(path.resolve(folder));
  const address = `http://127.0.0.1:${server.address().port}/`;
  const executablePath = process.env.PUSHPLAN_CHROMIUM ?? '/usr/bin/chromium';
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu'] });
  let wrong = [];
  try {
    if (what !== 'tasks') wrong = wrong.concat(await usedAsPeopleDo(browser, address, path.resolve(folder)));
    if (what !== 'page') wrong = wrong.concat(await tasks(browser, address, words));
  } finally {
    await browser.close();
    server.close();
  }
  for (const line of wrong) console.error(`WRONG: ${line}`);
  process.exitCode = wrong.length ? 1 : 0;
}

main(process.argv.slice(2));
