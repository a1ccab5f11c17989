// A corner of a strip (strips.h): its place in the picture, and the stored slices that the strip lies between. The
// plane may be slanted: the weight is interpolated with perspective.
layout(location = 0) in vec3 in_place;  // NDC times w, and w
layout(location = 1) in vec3 in_strip;
layout(location = 0) out vec3 out_strip;

void main() {
  gl_Position = vec4(in_place.xy, .5 * in_place.z, in_place.z);
  out_strip = in_strip;
}
