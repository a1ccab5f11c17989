// What methods share that show an isosurface (scenes/scene.h, Isosurface): how a slice tells where a ray meets it, and
// its colour. Put behind volume_common.glsl. The C++ side is isosurface.h, the twin isosurface_twin-inl.h.
//
// A slice stands for the stretch of the pixel's ray from its plane to the next slice behind it; the first stretch
// begins where the ray enters the volume. Surfaces are opaque: the nearest stretch that holds one wins, by depth or by
// order.
layout(std140, binding = 5) uniform SurfaceUniforms {
  vec4 colour;   // rgb; w: s_n of the surface
  vec4 ambient;  // reflectance of ambient light times the ambient light
  vec4 vectors;  // x, y: a stored gradient or normal is texel * x + y
}
surface;

// Rounding that is no miss, in stretches: whether the last slice is met where the ray leaves the volume.
const float kSlack = 1e-4;

// Where on a stretch from 0 to 1 the surface is first met, with values `front` and `back` at its ends; beyond 1:
// nowhere. Only the front: the slice itself, as the alpha test has it.
float meet_slice(float front) { return front >= surface.colour.w ? 0. : 2.; }
// On the line between both: one step of the secant method.
float meet_line(float front, float back) {
  if (front >= surface.colour.w) return 0.;
  if (!(back >= surface.colour.w)) return 2.;
  return clamp((surface.colour.w - front) / (back - front), 0., 1.);
}

#ifndef VM_WITHOUT_LIGHTING
// Of a point of the surface with normal n.
vec4 shade_surface(vec3 n, vec3 box) {
  vec3 diffuse = vec3(0.), specular = vec3(0.);
  add_lights(n, box, diffuse, specular);
  return vec4(surface.ambient.rgb + surface.colour.rgb * diffuse + specular, 1.);
}
#endif
