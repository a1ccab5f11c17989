// A corner of a section: one edge and one plane, which the host has paired (lensch2002, section 5).
layout(location = 0) in vec2 in_pair;  // number of the edge, number of the plane

// Fake vertices: 12 floats an edge, two positions and two texture coordinates.
layout(std430, binding = 5) readonly buffer Edges { float edges[]; };

#ifdef VM_SHELL_LIT
// 18 floats an edge: the cotangents of its ends.
layout(std430, binding = 7) readonly buffer Cotangents { float cotangents[]; };

vec3 column_at(int i) { return vec3(cotangents[i], cotangents[i + 1], cotangents[i + 2]); }
#endif

vec3 vector_at(int i) { return vec3(edges[i], edges[i + 1], edges[i + 2]); }

void main() {
  int base = 12 * int(in_pair.x);
  float plane = in_pair.y;
  vec3 a = vector_at(base), b = vector_at(base + 3);
  vec2 weights = edge_weights(plane_depth(a) - plane, plane_depth(b) - plane);
  vec3 p = on_edge(weights, a, b);
  gl_Position = on_plane(p, plane);
  out_texture = on_edge(weights, vector_at(base + 6), vector_at(base + 9));
#ifdef VM_SHELL_LIT
  int own = 18 * int(in_pair.x);
  out_box = p * (.5 * shell.lens.w) + .5;
  out_gradient_u = on_edge(weights, column_at(own), column_at(own + 9));
  out_gradient_v = on_edge(weights, column_at(own + 3), column_at(own + 12));
  out_gradient_w = on_edge(weights, column_at(own + 6), column_at(own + 15));
#endif
}
