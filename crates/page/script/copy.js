// Export: a command, a script, a plan file, a link.

(() => {
  const file = () => {
    const { schema_version, task } = page.file;
    const { tools, file: own } = plan();
    const whole = {
      schema_version, kind: 'plan', plan: own, model: null, predicted: null, verdict: null,
      tools: tools.map((tool) => page.tools[tool].file), task,
    };
    return JSON.stringify(whole, null, 2);
  };

  whenPlanChanges.push(() => {
    byId('command').textContent = plan().command;
    byId('command-details').hidden = !plan().command;
    byId('python').textContent = plan().python;
    byId('python-details').hidden = !plan().python;
    byId('file-details').hidden = !plan().file;
    byId('file').textContent = plan().file ? file() : '';
  });
  // An embedded page has no address of its own.
  byId('link-details').hidden = location.protocol === 'about:';
  whenTimeChanges.push(() => {
    byId('link').textContent = `${location.href.split('#')[0]}#${linkPart()}`;
  });

  for (const button of document.querySelectorAll('[data-copy]')) {
    button.addEventListener('click', async () => {
      const source = byId(button.dataset.copy);
      try {
        await navigator.clipboard.writeText(source.textContent);
        button.textContent = 'Copied';
      } catch {
        // If the browser denies access to the clipboard, the text is selected for copying.
        getSelection().selectAllChildren(source);
        button.textContent = 'Selected: press Ctrl-C';
      }
      setTimeout(() => { button.textContent = 'Copy'; }, 2000);
    });
  }
})();
