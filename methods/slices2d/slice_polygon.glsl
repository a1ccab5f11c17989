// What the fragment programs of object-aligned slices share: where the pixel's ray meets the slices that its polygon
// carries, and the texels there (rezksalama2000, sections 4 to 6). Goes behind stack_page.glsl; twin:
// slice_polygon-inl.h. All coordinates are in the stack's frame: z runs across the slices.
VM_SPEC(6, VM_TEXTURES, 1)     // slices on a polygon, at most
VM_SPEC(7, VM_INTERPOLATE, 1)  // 0: the nearest stored slice; 1: their eq. 1
VM_SPEC(8, VM_CORRECTED, 1)    // 0: every slice on the polygon is drawn where the first one is

layout(location = 0) in vec2 group;  // the first slice, which is the farthest; slices on this polygon, negative downwards
layout(location = 0) out vec4 colour;

// vm.own[0]: NDC = window * xy + (-1, 1); z: stored slice at slice 0; w: stored slices less one.
// vm.own[3]: x: z of slice 0; y: distance of slices; z: stored slices from one to the next.

float slice_position(float k) { return vm.own[3].x + k * vm.own[3].y; }
// The slab around slice k, inside the box: x: middle, y: thickness.
vec2 slab_of(float k) {
  float low = max(slice_position(k - .5), 0.), high = min(slice_position(k + .5), 1.);
  return vec2(.5 * (low + high), high - low);
}

// ---- Sampling ----
// The stored slices that make up a point of the slab around slice k: the one that is nearest to k (half way: the even
// one, so that slices are not shifted as a whole), or the two around the point for their eq. 1.
struct Stored {
  float below, above, weight;  // of `above`
};
Stored stored_around(float k, vec3 box) {
  float first = vm.own[2].w, last = vm.own[3].w;
  if (VM_INTERPOLATE == 0) {
    float nearest = clamp(roundEven(vm.own[0].z + k * vm.own[3].z), first, last);
    return Stored(nearest, nearest, 0.);
  }
  float place = box.z * vm.own[0].w;
  float below = clamp(floor(place), first, max(last - 1., first));
  return Stored(below, min(below + 1., last), clamp(place - below, 0., 1.));
}

vec4 sample_slice(float k, vec3 box) {
  vec2 at = place_in_slice(box);
  Stored stored = stored_around(k, box);
  if (VM_INTERPOLATE == 0) return texel_of(stored.below, at);
  return mix(texel_of(stored.below, at), texel_of(stored.above, at), stored.weight);
}

// ---- The pixel's ray and the slices of the polygon ----
struct PolygonRay {
  vec3 origin, direction;
  float begin, end;            // inside of the clipped volume
  float unit, inverse;         // world units, and units of depth over unit z, per unit of depth
  float first, toward, count;  // slices: first, first + toward, ...
};
PolygonRay polygon_ray() {
  vec2 ndc = gl_FragCoord.xy * vm.own[0].xy + vec2(-1., 1.);
  PolygonRay ray;
  ray.origin = ray_origin(ndc);
  ray.direction = ray_direction(ndc);
  ray.begin = vm.depth.x;
  ray.end = 1e30;
  clip_ray(ray.origin, ray.direction, ray.begin, ray.end);
  ray.unit = ray_length(ray.direction);
  // A ray along the slices meets one slab with all of its length, or two that share a face with half of it each.
  ray.inverse = 1. / (abs(ray.direction.z) < 1e-20 ? 1e-20 : ray.direction.z);
  ray.first = floor(group.x + .5);
  ray.toward = group.y < 0. ? -1. : 1.;
  ray.count = floor(abs(group.y) + .5);
  return ray;
}

// The stretch of the ray in the slab of one slice. Its middle is where the ray meets the slice (their eq. 2, for each
// pixel instead of each corner); at the rim of the volume it is the middle of what is left. Outside of the slice the
// stretch is empty ("zero outside").
struct Meeting {
  float face;  // where the ray comes out of the slab
  vec3 box;
  float len;  // world units
};
Meeting before_slices(PolygonRay ray) {
  float face = (slice_position(ray.first - .5 * ray.toward) - ray.origin.z) * ray.inverse;
  return Meeting(face, vec3(0.), 0.);
}
// From the slice before to slice k, which is number `i` of the polygon.
Meeting next_slice(PolygonRay ray, float k, int i, Meeting meeting) {
  if (VM_CORRECTED == 1 || i == 0) {
    float next = (slice_position(k + .5 * ray.toward) - ray.origin.z) * ray.inverse;
    float begin = max(ray.begin, min(meeting.face, next)), end = min(ray.end, max(meeting.face, next));
    return Meeting(next, ray.origin + (.5 * (begin + end)) * ray.direction, max(end - begin, 0.) * ray.unit);
  }
  vec2 slab = slab_of(k);
  return Meeting(meeting.face, vec3(meeting.box.xy, slab.x), meeting.len * (slab.y / slab_of(k - ray.toward).y));
}
