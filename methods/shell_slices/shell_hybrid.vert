// A corner of a section: one edge and one plane, which the host has paired (lensch2002, section 5).
layout(location = 0) in vec2 in_pair;  // number of the edge, number of the plane
layout(location = 0) out vec3 out_texture;

// Fake vertices: 12 floats an edge, two positions and two texture coordinates.
layout(std430, binding = 2) readonly buffer Edges { float edges[]; };

vec3 vector_at(int i) { return vec3(edges[i], edges[i + 1], edges[i + 2]); }

void main() {
  int base = 12 * int(in_pair.x);
  float plane = in_pair.y;
  vec3 a = vector_at(base), b = vector_at(base + 3);
  vec2 weights = edge_weights(plane_depth(a) - plane, plane_depth(b) - plane);
  gl_Position = on_plane(on_edge(weights, a, b), plane);
  out_texture = on_edge(weights, vector_at(base + 6), vector_at(base + 9));
}
