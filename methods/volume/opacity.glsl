// Opacity 1 - exp(-x) of optical depth x >= 0 with full relative accuracy for small x (an expm1: GLSL has none).
// x = k ln 2 - r with |r| <= ln 2 / 2, and 1 - 2^-k e^r = (1 - 2^-k) - 2^-k (e^r - 1).
float exact_opacity(float x) {
  float y = min(x, 80.);
  float k = floor(y * 1.44269504 + .5);
  float r = (k * .693359375 - y) - k * 2.12194440e-4;
  float e = r * (1. + r * (1. / 2. + r * (1. / 6. + r * (1. / 24. + r * (1. / 120. + r * (1. / 720. + r * (1. / 5040.)))))));
  float p = intBitsToFloat((127 - int(k)) << 23);
  return (1. - p) - p * e;
}
