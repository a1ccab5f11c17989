// Theme, help and copy buttons; starts the other parts.
(() => {
  const stored = (() => { try { return localStorage.getItem('volumark-theme'); } catch { return null; } })();
  if (stored === 'dark' || stored === 'light') document.documentElement.dataset.theme = stored;
  const isDark = () => {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  };
  const name = () => { vm.byId('theme').textContent = isDark() ? 'Light' : 'Dark'; };
  const toggle = () => {
    document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
    try { localStorage.setItem('volumark-theme', document.documentElement.dataset.theme); } catch { /* not kept */ }
    name();
    vm.say(isDark() ? 'Dark' : 'Light');
  };
  vm.byId('theme').addEventListener('click', toggle);
  name();

  const help = vm.byId('help');
  vm.byId('show-help').addEventListener('click', () => help.showModal());
  addEventListener('keydown', (event) => {
    if (event.target.matches?.('input[type=search], textarea, select') || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === '?' && !help.open) help.showModal();
    else if (event.key === 'd' && !help.open) toggle();
    else return;
    event.preventDefault();
  });

  document.addEventListener('click', async (event) => {
    const button = event.target.closest('.copy');
    if (!button) return;
    await vm.copy(button.dataset.copy);
    button.textContent = 'copied';
    vm.say('Command copied');
    setTimeout(() => { button.textContent = 'copy'; }, 1500);
  });

  vm.startSorting();
  vm.startDetails();
  vm.startFilter();
  vm.startPlots();
  vm.startThumbs();
  vm.startSpots();
  vm.startViewerKeys();
  vm.viewer.start();
  document.documentElement.dataset.ready = 'true';
})();
