// Embedded PNG files: decoded when first needed, without colour conversion, so that the bytes read from a canvas are
// the bytes of the file.
vm.pictures = (() => {
  const blobs = new Map();
  const decoded = new Map();  // the most recently used last
  const kept = 24;

  const blob = (index) => {
    if (!blobs.has(index)) {
      const text = atob(vm.byId(`picture-${index}`).textContent);
      const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
      blobs.set(index, new Blob([bytes], {type: 'image/png'}));
    }
    return blobs.get(index);
  };

  const decode = async (index) => {
    const bitmap = await createImageBitmap(blob(index), {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
    const canvas = vm.make('canvas', {width: bitmap.width, height: bitmap.height});
    const context = canvas.getContext('2d', {willReadFrequently: true});
    context.drawImage(bitmap, 0, 0);
    const {data} = context.getImageData(0, 0, bitmap.width, bitmap.height);
    return {canvas, data, width: bitmap.width, height: bitmap.height};
  };

  // {canvas, data (RGBA bytes), width, height}; null for index -1. Rejects where the file is damaged.
  const get = (index) => {
    if (index < 0) return Promise.resolve(null);
    const found = decoded.get(index) ?? decode(index);
    decoded.delete(index);
    decoded.set(index, found);
    if (decoded.size > kept) decoded.delete(decoded.keys().next().value);
    return found;
  };

  const url = (index) => URL.createObjectURL(blob(index));

  // 8-bit sRGB code to linear.
  const linear = Float64Array.from({length: 256}, (_, code) => {
    const v = code / 255;
    return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  });
  return {get, url, linear};
})();

// Small pictures are loaded when they come into sight (all of them before printing).
vm.startThumbs = () => {
  const load = (button) => {
    const frame = button.querySelector('.frame');
    if (frame.childElementCount > 0) return;
    frame.append(vm.make('img', {src: vm.pictures.url(Number(button.dataset.picture)), alt: ''}));
  };
  const all = document.querySelectorAll('.thumb');
  const observer = new IntersectionObserver((entries) => {
    for (const entry of entries)
      if (entry.isIntersecting) {
        load(entry.target);
        observer.unobserve(entry.target);
      }
  }, {rootMargin: '300px'});
  for (const button of all) {
    observer.observe(button);
    button.addEventListener(
        'click', () => vm.viewer.show(Number(button.dataset.entry), true, Number(button.dataset.against ?? -1)));
  }
  addEventListener('beforeprint', () => all.forEach(load));
};
