// One polygon of an object-aligned stack with the textures of one, two or four slices (rezksalama2000, sections 4 to 6).
// All coordinates are in the stack's frame: z runs across the slices. Twin: slices2d_twin.cpp.
VM_SPEC(6, VM_TEXTURES, 1)     // slices on a polygon, at most
VM_SPEC(7, VM_INTERPOLATE, 1)  // 0: the nearest stored slice; 1: their eq. 1
VM_SPEC(8, VM_CORRECTED, 1)    // 0: every slice on the polygon is drawn where the first one is

layout(binding = 4) uniform sampler2D page;  // tiles: the stored slices of the stack, or some of them

layout(location = 0) in vec2 group;  // the first slice, which is the farthest; slices on this polygon, negative downwards
layout(location = 0) out vec4 colour;

// vm.own[0]: NDC = window * xy + (-1, 1); z: stored slice at slice 0; w: stored slices less one.
// vm.own[1]: xy: a tile in texture coordinates; zw: texture coordinates in the tile per coordinate of the slice alone.
// vm.own[2]: xy: gutter in texture coordinates; z: tiles in a row; w: first stored slice of the page.
// vm.own[3]: x: z of slice 0; y: distance of slices; z: stored slices from one to the next; w: last stored slice of the
// page.

float slice_position(float k) { return vm.own[3].x + k * vm.own[3].y; }
// The slab around slice k, inside the box: x: middle, y: thickness.
vec2 slab_of(float k) {
  float low = max(slice_position(k - .5), 0.), high = min(slice_position(k + .5), 1.);
  return vec2(.5 * (low + high), high - low);
}

vec4 texel_of(float stored, vec2 at) {
  float place = stored - vm.own[2].w;
  float row = floor((place + .5) / vm.own[2].z);
  vec2 tile = vec2(place - row * vm.own[2].z, row);
  return textureLod(page, tile * vm.own[1].xy + vm.own[2].xy + at * vm.own[1].zw, 0.);
}

// The texel at a point of the slab around slice k: of the stored slice that is nearest to k (half way: of the even one,
// so that slices are not shifted as a whole), or their eq. 1 of the two around the point.
vec4 sample_slice(float k, vec3 box) {
  vec2 at = clamp(box.xy, 0., 1.) * vm.texture_scale.xy + vm.texture_offset.xy;
  float first = vm.own[2].w, last = vm.own[3].w;
  if (VM_INTERPOLATE == 0) return texel_of(clamp(roundEven(vm.own[0].z + k * vm.own[3].z), first, last), at);
  float stored = box.z * vm.own[0].w;
  float below = clamp(floor(stored), first, max(last - 1., first));
  return mix(texel_of(below, at), texel_of(min(below + 1., last), at), clamp(stored - below, 0., 1.));
}

// Premultiplied colour and opacity of `len` world units of the slab around slice k.
vec4 shade_slice(float k, vec3 box, float len) {
  vec4 texel = sample_slice(k, box);
  if (VM_CLASSIFICATION == 1) return shade_classified(texel, len);
  return shade_segment(transfer((texel.r - vm.value.x) * vm.value.y), len, box);
}

void main() {
  vec2 ndc = gl_FragCoord.xy * vm.own[0].xy + vec2(-1., 1.);
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
  vec3 box = vec3(0.);
  for (int i = 0; i < VM_TEXTURES; ++i) {
    float k = first + toward * float(i);
    if (VM_CORRECTED == 1 || i == 0) {
      // The stretch of the ray in the slab. Its middle is where the ray meets the slice (their eq. 2, for each pixel
      // instead of each corner); at the rim of the volume it is the middle of what is left. Outside of the slice the
      // stretch is empty ("zero outside").
      float next = (slice_position(k + .5 * toward) - origin.z) * inverse;
      float begin = max(z0, min(face, next)), end = min(z1, max(face, next));
      face = next;
      box = origin + (.5 * (begin + end)) * direction;
      len = max(end - begin, 0.) * unit;
    } else {
      vec2 slab = slab_of(k);
      box.z = slab.x;
      len *= slab.y / slab_of(k - toward).y;
    }
    if (float(i) < count && len > 0.) {
      vec4 slice = shade_slice(k, box, len);
      colour = slice + (1. - slice.a) * colour;  // their eq. 3 to 5
    }
  }
}
