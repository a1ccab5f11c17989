// All that the file says of a cell, in a row below it; made when it is opened.
vm.closeDetails = (table) => {
  for (const row of table.querySelectorAll('tr.details')) row.remove();
  for (const button of table.querySelectorAll('.more')) button.setAttribute('aria-expanded', 'false');
};

vm.startDetails = () => {
  const block = (title, pairs) => {
    const body = vm.make('tbody');
    for (const [name, text] of pairs)
      body.append(vm.make('tr', {}, vm.make('th', { scope: 'row', className: 'dim', textContent: name }),
        vm.make('td', { textContent: text })));
    return vm.make('div', {}, vm.make('h4', { textContent: title }), vm.make('table', {}, body));
  };
  const stats = (metric) => `${vm.ms(metric.stats.median)} ms (p5 ${vm.ms(metric.stats.p5)}, p95 ${vm.ms(metric.stats.p95)})`;
  const timeBlock = (metrics) => {
    const pairs = [['frame, wall', stats(metrics.frame_wall)], ['frame, CPU', stats(metrics.frame_cpu)]];
    const { median, count } = metrics.frame_wall.stats;
    if (median > 0) pairs.push(['frames a second', vm.number(1 / median)]);
    pairs.push(['frames measured', `${count}, stopped by ${metrics.timing.stopped}`]);
    pairs.push(['prepare', `${vm.ms(metrics.prepare.wall)} ms, CPU ${vm.ms(metrics.prepare.cpu)} ms`]);
    for (const [zone, seconds] of Object.entries(metrics.prepare.zones)) pairs.push([`prepare: ${zone}`, `${vm.ms(seconds)} ms`]);
    for (const [zone, metric] of Object.entries(metrics.zones)) pairs.push([`zone ${zone}`, stats(metric)]);
    return block('Time', pairs);
  };
  const workBlock = (metrics) => {
    const mib = (bytes) => `${vm.number(bytes / 1048576)} MiB`;
    const bytes = metrics.peak_bytes;
    return block('Work and memory', [
      ...Object.entries(metrics.counters).map(([name, count]) => [name, Number(count.toPrecision(6)).toLocaleString('en')]),
      ['peak on the device', mib(bytes.device)], ['peak of the process', mib(bytes.process)],
      ['voxels', mib(bytes.voxels)], ['target', mib(bytes.target)]]);
  };
  const errorBlock = (worst, mean) => {
    const pairs = ['rmse', 'mae', 'max', 'p50', 'p95', 'p99', 'flip_mean', 'flip_p99', 'ciede2000_mean', 'ciede2000_p99',
      'ssim', 'psnr', 'over_1_255', 'alpha_rmse', 'alpha_max', 'non_finite']
      .map((name) => [name === 'over_1_255' ? 'share over 1/255' : name.replaceAll('_', ' '), `${vm.number(worst[name])} (mean ${vm.number(mean[name])})`]);
    pairs.push(['bias R G B', worst.bias.map(vm.scientific).join('  ')]);
    return block('Error: worst view (mean of the views)', pairs);
  };
  const regionBlock = (regions) => block('Regions, worst view', Object.entries(regions).map(([name, region]) =>
    [name, `RMSE ${vm.scientific(region.rmse)}, max ${vm.scientific(region.max)}, ${region.pixels} pixels`]));
  const viewBlock = (views) => block('Views', views.map((view) => [view.name || `view ${view.index}`,
    [view.frame_wall ? `${vm.ms(view.frame_wall.median)} ms` : 'not timed',
      view.error ? `RMSE ${vm.scientific(view.error.rmse)}` : 'no error',
      view.reference ? `bound ${vm.scientific(view.reference.bound)}` : '',
      view.jump ? `jump ${vm.scientific(view.jump)}` : '',
      view.shows_nothing ? 'shows nothing' : '',
      view.at_bound ? 'at the reference\u2019s bound' : ''].filter(Boolean).join(', ')]));
  const describe = (result) => {
    const parameters = Object.entries(result.key.params).map(([name, v]) => [name, String(v)]);
    const grid = vm.make('div', { className: 'detail-grid' }, block('Parameters', [...parameters,
      ...(result.key.variant ? [['effects switched', result.key.variant]] : []),
      ...(result.ignored_effects?.length > 0 ? [['ignored effects', result.ignored_effects.join(', ')]] : []),
      ['image', `${result.width} \u00d7 ${result.height}`], ['effects', result.effects.join(', ') || 'none'],
      ['case', result.case_version]]));
    if (result.metrics) grid.append(timeBlock(result.metrics), workBlock(result.metrics));
    if (result.error) grid.append(errorBlock(result.error.worst, result.error.mean));
    if (result.error && Object.keys(result.error.worst.regions).length > 0) grid.append(regionBlock(result.error.worst.regions));
    if (result.programs?.length > 0) grid.append(block('Instructions', result.programs.map((p) => [`${p.program}, ${p.stage}`, String(p.instructions)])));
    if (result.views.length > 0) grid.append(viewBlock(result.views));
    const box = vm.make('div', {});
    if (result.reason) box.append(vm.make('p', { textContent: result.reason }));
    box.append(grid, vm.commandBox(result.command));
    return box;
  };
  const toggle = (button) => {
    const row = button.closest('tr');
    const open = button.getAttribute('aria-expanded') === 'true';
    button.setAttribute('aria-expanded', String(!open));
    if (open) {
      row.nextElementSibling?.classList.contains('details') && row.nextElementSibling.remove();
      return;
    }
    const cell = vm.make('td', { colSpan: row.cells.length }, describe(vm.results.results[Number(row.dataset.cell)]));
    row.after(vm.make('tr', { className: 'details' }, cell));
  };
  vm.byId('cell-table').addEventListener('click', (event) => {
    const button = event.target.closest('.more');
    if (button) toggle(button);
  });
};
