// One polygon of an object-aligned stack with the textures of one, two or four slices (rezksalama2000, sections 4 to 6).
// All coordinates are in the stack's frame: z runs across the slices. Twin: slices2d_twin.cpp.
VM_SPEC(6, VM_TEXTURES, 1)     // slices on a polygon, at most
VM_SPEC(7, VM_INTERPOLATE, 1)  // 0: the nearest stored slice; 1: their eq. 1
VM_SPEC(8, VM_CORRECTED, 1)    // 0: every slice on the polygon is drawn where the first one is

layout(binding = 4) uniform sampler2D page;  // tiles: the stored slices of the stack, or some of them

layout(location = 0) in vec2 group;  // the first slice, which is the farthest; slices on this polygon, negative downwards
layout(location = 0) out vec4 colour;

// vm.own[0]: NDC = window * xy + zw.
// vm.own[1]: xy: a tile in texture coordinates; zw: texture coordinates in the tile per coordinate of the slice alone.
// vm.own[2]: xy: gutter in texture coordinates; z: tiles in a row; w: first stored slice of the page.
// vm.own[3]: x: z of slice 0; y: distance of slices; z: stored slices from one to the next; w: last stored slice of the
// page.

float slice_position(float k) { return vm.own[3].x + k * vm.own[3].y; }
// Of the part of its slab inside the box.
float slab_thickness(float k) { return min(slice_position(k + .5), 1.) - max(slice_position(k - .5), 0.); }

vec4 texel_of(float stored, vec2 at) {
  float place = stored - vm.own[2].w;
  float row = floor((place + .5) / vm.own[2].z);
  vec2 tile = vec2(place - row * vm.own[2].z, row);
  return textureLod(page, tile * vm.own[1].xy + vm.own[2].xy + at * vm.own[1].zw, 0.);
}

// The texel of slice k at a point of the slice (their eq. 1).
vec4 sample_slice(float k, vec2 box) {
  vec2 at = clamp(box, 0., 1.) * vm.texture_scale.xy + vm.texture_offset.xy;
  float stored = k * vm.own[3].z;
  if (VM_INTERPOLATE == 0) return texel_of(clamp(floor(stored + .5), vm.own[2].w, vm.own[3].w), at);
  float below = clamp(floor(stored), vm.own[2].w, max(vm.own[3].w - 1., vm.own[2].w));
  float above = min(below + 1., vm.own[3].w);
  return mix(texel_of(below, at), texel_of(above, at), clamp(stored - below, 0., 1.));
}

// Premultiplied colour and opacity of `len` world units of the slab around slice k.
vec4 shade_slice(float k, vec2 box, float len) {
  vec4 texel = sample_slice(k, box);
  if (VM_CLASSIFICATION == 1) return shade_classified(texel, len);
  return shade_segment(transfer((texel.r - vm.value.x) * vm.value.y), len, vec3(box, 0.));
}

void main() {
  vec2 ndc = gl_FragCoord.xy * vm.own[0].xy + vm.own[0].zw;
  vec3 origin = ray_origin(ndc), direction = ray_direction(ndc);
  float z0 = vm.depth.x, z1 = 1e30;
  clip_ray(origin, direction, z0, z1);
  float unit = ray_length(direction);
  // A ray along the slices meets one slab with all of its length, or two that share a face with half of it each.
  float inverse = 1. / (abs(direction.z) < 1e-20 ? 1e-20 : direction.z);
  float first = floor(group.x + .5), toward = group.y < 0. ? -1. : 1., count = floor(abs(group.y) + .5);

  colour = vec4(0.);
  float face = (slice_position(first - .5 * toward) - origin.z) * inverse;
  float len = 0.;
  vec2 box = vec2(0.);
  for (int i = 0; i < VM_TEXTURES; ++i) {
    float k = first + toward * float(i);
    if (VM_CORRECTED == 1 || i == 0) {
      // The stretch of the ray in the slab, and where the ray meets the slice: their eq. 2, for each pixel instead of
      // each corner. Outside of the slice the stretch is empty ("zero outside").
      float next = (slice_position(k + .5 * toward) - origin.z) * inverse;
      float begin = max(z0, min(face, next)), end = min(z1, max(face, next));
      face = next;
      float meets = min(max((slice_position(k) - origin.z) * inverse, begin), end);
      box = origin.xy + meets * direction.xy;
      len = max(end - begin, 0.) * unit;
    } else {
      len *= slab_thickness(k) / slab_thickness(k - toward);
    }
    if (float(i) < count && len > 0.) {
      vec4 slice = shade_slice(k, box, len);
      colour = slice + (1. - slice.a) * colour;  // their eq. 3 to 5
    }
  }
}
