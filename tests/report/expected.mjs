// The figures that the report must show, worked out anew from results.json: nothing is shared with the C++ that wrote it.

export const columns = [['rmse', 1e-2], ['rmse', 3e-3], ['rmse', 1e-3], ['rmse', 3e-4], ['flip_p99', 0.1], ['flip_p99', 0.05],
  ['flip_p99', 0.02]];

// Three significant digits; exponents below 1e-3 and from 1e6.
export const number = (value) => {
  if (value === 0) return '0';
  const [, exponent] = value.toExponential(2).split('e').map(Number);
  return exponent < -3 || exponent > 5 ? scientific(value) : Number(value.toPrecision(3)).toFixed(Math.max(0, 2 - exponent));
};
export const scientific = (value) => (value === 0 ? '0' : value.toExponential(2));
export const ms = (seconds) => number(seconds * 1e3);

// What a cell's row is called beside its method and backend: the parameters off the quality axis that vary in its scene.
export const settingOf = (results, cell) => {
  const same = results.results.filter(({ key }) => key.experiment === cell.key.experiment && key.scene === cell.key.scene && key.method === cell.key.method);
  const names = Object.keys(cell.key.params).filter((name) => name !== cell.quality?.parameter && new Set(same.map(({ key }) => key.params[name])).size > 1);
  return [...names.sort().map((name) => `${name} ${cell.key.params[name]}`),
    ...(cell.ignored_effects.length > 0 ? [`ignores ${cell.ignored_effects.join(', ')}`] : [])].join(', ');
};

// Cells that count: [{time, error}].
export const points = (results, { experiment, scene, method, backend, setting }, metric) => results.results
  .filter((cell) => cell.key.experiment === experiment && cell.key.scene === scene && cell.key.method === method
    && cell.key.backend === backend && cell.key.variant === '' && (setting === undefined || settingOf(results, cell) === setting)
    && cell.ignored_effects.length === 0 && !cell.views.every(({ shows_nothing }) => shows_nothing)
    && (cell.outcome === 'ok' || cell.outcome === 'wrong_image') && cell.metrics && cell.error)
  .map((cell) => {
    const bound = Math.max(0, ...cell.views.map((view) => view.reference?.bound ?? 0));
    const error = cell.error.worst[metric];
    return { time: cell.metrics.frame_wall.stats.median, error: metric === 'rmse' ? Math.max(error, bound) : error };
  });

// What a field of the time-to-error table says.
export const timeToError = (all, target) => {
  const front = all.filter((p) => !all.some((q) => q !== p && q.time <= p.time && q.error <= p.error && (q.time < p.time || q.error < p.error)))
    .sort((p, q) => p.time - q.time);
  if (front.length === 0) return 'n/a';
  const at = front.findIndex((p) => p.error <= target);
  if (at < 0) return `not reached, best ${scientific(front.at(-1).error)}`;
  if (at === 0) return `\u2264\u2009${ms(front[0].time)}`;
  const [coarse, fine] = [front[at - 1], front[at]];
  if (!(fine.error > 0)) return `\u2264\u2009${ms(fine.time)}`;
  const share = (Math.log(coarse.error) - Math.log(target)) / (Math.log(coarse.error) - Math.log(fine.error));
  return ms(coarse.time * (fine.time / coarse.time) ** share);
};
