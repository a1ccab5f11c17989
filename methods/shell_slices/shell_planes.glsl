// What the programs of shells share: the uniform block and the arithmetic of a plane and an edge, operation by operation
// that of shell_frame.h. `precise`: contracted to fused multiply-adds, the depth of a corner could differ between two
// places that ask for it, and neighbouring prisms would disagree about a sign.
layout(std140, binding = 4) uniform ShellUniforms {
  vec4 depth;   // depth = dot(xyz, p) + w; the plane with number k is where depth = k
  vec4 across;  // NDC x = (dot(xyz, p) + w) / lens(k)
  vec4 up;      // NDC y, likewise
  vec4 lens;    // x + y k: the divisor on plane k; z: number of planes; w: 1 / the radius of the shell
  vec4 window;  // NDC = xy * window + (-1, 1); zw: a ray is sqrt(1 + (zw * NDC)^2) long per unit of depth
  vec4 texture; // x, y: where w is clamped to; z: world units between planes; w: what texels are multiplied by
  vec4 texel;   // between neighbouring texels, in texture coordinates; w: unused
  vec4 slope;   // what differences of texels on both sides are multiplied by to be a gradient; w: unused
} shell;

float along_axis(vec4 axis, vec3 p) {
  precise float sum = ((p.x * axis.x + p.y * axis.y) + p.z * axis.z) + axis.w;
  return sum;
}

float plane_depth(vec3 p) { return along_axis(shell.depth, p); }

// Weights of the ends of an edge at the point on the plane; depths less the plane's number.
vec2 edge_weights(float depth_a, float depth_b) {
  float a = abs(depth_b), b = abs(depth_a);
  precise float sum = a + b;
  return sum > 0. ? vec2(a / sum, b / sum) : vec2(.5);
}

vec3 on_edge(vec2 weights, vec3 a, vec3 b) {
  precise vec3 p = weights.x * a + weights.y * b;
  return p;
}

vec4 on_plane(vec3 p, float plane) {
  precise float lens = shell.lens.x + plane * shell.lens.y;
  return vec4(along_axis(shell.across, p) / lens, along_axis(shell.up, p) / lens, .5, 1.);
}
