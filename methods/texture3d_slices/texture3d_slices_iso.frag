// One slice of an isosurface by the alpha test (westermann1998; rezksalama2000, section 7): whether the stretch of the
// pixel's ray between this slice and the next shows the surface, and with what colour.
VM_SPEC(6, VM_REFINE, 0)     // 1: on the line between both ends of the stretch
VM_SPEC(7, VM_GRADIENTS, 0)  // 0: texels are values; 1: gradient and value; 2: normal and value
layout(location = 0) flat in float plane;  // depth of what is half way between the two slices
layout(location = 0) out vec4 colour;

vec4 texel_at(vec3 at) { return textureLod(volume_texture, texture_position(at), 0.); }
float value_of(vec4 texel) { return ((VM_GRADIENTS == 0 ? texel.r : texel.a) - vm.value.x) * vm.value.y; }

void main() {
  // The pixel's own ray, in window coordinates: what is interpolated across a thin polygon is noise.
  vec3 direction = ray_direction(gl_FragCoord.xy);
  vec3 box = ray_origin(gl_FragCoord.xy) + plane * direction;
  float enter = -1e30, leave = 1e30;
  clip_ray(box, direction, enter, leave);
  float z0 = max(-.5 * vm.depth.w, enter), z1 = min(.5 * vm.depth.w, leave);
  if (!(enter < leave && z0 <= z1 + kSlack * vm.depth.w)) discard;
  vec4 texel = texel_at(box + z0 * direction);
  float met;
  if (VM_REFINE == 1) {
    vec4 back = texel_at(box + z1 * direction);
    met = meet_line(value_of(texel), value_of(back));
    texel = mix(texel, back, met);
  } else {
    met = meet_slice(value_of(texel));
  }
  if (met > 1.) discard;
  colour = vec4(surface.colour.rgb, 1.);
#ifndef VM_WITHOUT_LIGHTING
  if (VM_LIGHTS > 0) {
    vec3 hit = box + (z0 + met * (z1 - z0)) * direction;
    vec3 vector = texel.rgb * surface.vectors.x + surface.vectors.y;
    vec3 n = VM_GRADIENTS == 0 ? normal_of(sample_gradient(hit)) : VM_GRADIENTS == 1 ? normal_of(vector) : vector;
    colour = shade_surface(n, hit);
  }
#endif
}
