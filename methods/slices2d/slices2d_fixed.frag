// The slices of one polygon of an object-aligned stack in the arithmetic of the boards of 2000; the definition is in
// docs/effects.md. Twin: slices2d_fixed_twin.cpp. All coordinates are in the stack's frame.
VM_SPEC(5, VM_TEXTURES, 1)     // slices on a polygon, at most
VM_SPEC(6, VM_INTERPOLATE, 1)  // 0: the nearest stored slice
VM_SPEC(7, VM_CORRECTED, 1)    // 0: every slice on the polygon is drawn where the first one is

layout(std140, binding = 3) uniform SliceUniforms {
  vec4 slices;  // x: texel coordinate of slice 0; y: from one to the next; z: depth of the near plane
  vec4 tiles;   // x: tiles in a row; y: first stored slice of the page; z, w: texels of a tile
}
slice;
layout(binding = 1) uniform sampler2D page;

layout(location = 0) in vec2 group;  // the first slice, which is the farthest; slices on this polygon, negative downwards
layout(location = 0) out vec4 colour;

ivec2 texel_place(int x, int y, int z) {
  float place = float(z) - slice.tiles.y;
  float row = floor((place + .5) / slice.tiles.x);  // of whole numbers: half a tile from any rounding
  return ivec2(int(place - row * slice.tiles.x), int(row)) * ivec2(slice.tiles.zw) + ivec2(x + 1, y + 1);
}
int texel_red(int x, int y, int z) { return int(texelFetch(page, texel_place(x, y, z), 0).r * 255. + .5); }
ivec4 texel_rgba(int x, int y, int z) { return ivec4(texelFetch(page, texel_place(x, y, z), 0) * 255. + .5); }

// 1 / x by Newton's method, the same bits everywhere; |x| from 1e-12 on.
float reciprocal(float x) {
  float magnitude = max(abs(x), 1e-12);
  float r = intBitsToFloat(0x7ef311c7 - floatBitsToInt(magnitude));
  for (int i = 0; i < 4; ++i) {
    precise float better = r * (2. - magnitude * r);
    r = better;
  }
  return x < 0. ? -r : r;
}

// Texel coordinate of slice k, which is a stored one where it is whole.
float stored_at(float k) {
  precise float place = slice.slices.x + k * slice.slices.y;
  return place;
}

void main() {
  vec3 origin = window_origin(), direction = window_direction();
  float inverse = reciprocal(direction.z);
  float first = floor(group.x + .5), toward = group.y < 0. ? -1. : 1., count = floor(abs(group.y) + .5);
  ivec4 sum = ivec4(0);
  ivec3 t = ivec3(0);
  bool seen = false;
  for (int i = 0; i < VM_TEXTURES; ++i) {
    if (float(i) >= count) break;
    float stored = stored_at(first + toward * float(i));
    if (VM_CORRECTED == 1 || i == 0) {
      precise float z = (stored - origin.z) * inverse;
      t = position_of(origin, direction, z);
      seen = z >= slice.slices.z;
    }
    t.z = VM_INTERPOLATE == 1 ? int(floor(stored * 256. + .5)) : 256 * int(roundEven(stored));
    if (seen) {
      ivec4 sampled = sample_at(t);
      sum = min(sampled + product(sum, ivec4(255 - sampled.a)), 255);  // their eq. 3 to 5
    }
  }
  colour = vec4(sum) / 255.;
}
