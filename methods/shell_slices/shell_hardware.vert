// One of the six vertices of a prism on a plane, which finds its own place (lensch2002, section 6, Figure 5; which of
// two crossed edges is taken: hardware_edge() in section.h).
VM_SPEC(1, VM_BRANCHES, 0)  // 0: everything is computed and selected by weights of 0 and 1; 1: if
VM_SPEC(2, VM_LISTED, 0)    // 1: the pairs of prism and plane are listed; 0: every prism on the plane of the instance
layout(location = 0) out vec3 out_texture;

// 36 floats a vertex. Positions: own lower and upper, primary lower and upper, secondary lower and upper; then the
// texture coordinates of these.
layout(std430, binding = 2) readonly buffer Corners { float corners[]; };
layout(std430, binding = 3) readonly buffer Pairs { uvec2 pairs[]; };

vec3 vector_at(int i) { return vec3(corners[i], corners[i + 1], corners[i + 2]); }

// 1 where the ends of an edge are on different sides.
float crossed(float a, float b) { return abs(a - b); }

// The ends of the edge that is taken, as numbers of the six corners; (-1, -1): the plane misses the prism.
ivec2 branch(bool far[6]) {
  if (far[0] != far[1]) return ivec2(0, 1);
  for (int other = 2; other < 6; other += 2) {
    int third = 6 - other;
    bool lower = far[0] != far[other], upper = far[1] != far[other + 1];
    bool reversed = far[third] != far[third + 1] && far[third];
    if (lower && (!upper || far[0] != reversed)) return ivec2(0, other);
    if (upper) return ivec2(1, other + 1);
  }
  return ivec2(-1);
}

void main() {
  int vertex = VM_VERTEX;
  float plane;
  if (VM_LISTED == 1) {
    uvec2 pair = pairs[vertex / 6];
    vertex = 6 * int(pair.x) + vertex % 6;
    plane = float(pair.y);
  } else {
    plane = shell.lens.z - 1. - float(VM_INSTANCE);
  }
  int base = 36 * vertex;
  vec3 p[6];
  float depth[6];
  for (int i = 0; i < 6; ++i) {
    p[i] = vector_at(base + 3 * i);
    depth[i] = plane_depth(p[i]);
  }

  vec3 a, b, texture_a, texture_b;
  float depth_a, depth_b;
  float missed;  // 1: no edge is crossed
  if (VM_BRANCHES == 1) {
    bool far[6];
    for (int i = 0; i < 6; ++i) far[i] = depth[i] >= plane;
    ivec2 ends = branch(far);
    missed = ends.x < 0 ? 1. : 0.;
    ends = max(ends, ivec2(0));
    a = p[ends.x];
    b = p[ends.y];
    depth_a = depth[ends.x];
    depth_b = depth[ends.y];
    texture_a = vector_at(base + 18 + 3 * ends.x);
    texture_b = vector_at(base + 18 + 3 * ends.y);
  } else {
    float far[6];
    for (int i = 0; i < 6; ++i) far[i] = step(plane, depth[i]);
    // Validity: normal; primary lower and upper; secondary lower and upper. At most one of a pair.
    float normal = crossed(far[0], far[1]);
    float lower1 = crossed(far[0], far[2]), upper1 = crossed(far[1], far[3]);
    float lower2 = crossed(far[0], far[4]), upper2 = crossed(far[1], far[5]);
    float prefer1 = crossed(far[0], crossed(far[4], far[5]) * far[4]);
    float prefer2 = crossed(far[0], crossed(far[2], far[3]) * far[2]);
    lower1 *= 1. - upper1 * (1. - prefer1);
    upper1 *= 1. - lower1;
    lower2 *= 1. - upper2 * (1. - prefer2);
    upper2 *= 1. - lower2;
    // The paper's selection register: the first that is valid is taken.
    float select = 1. - normal;
    lower1 *= select;
    upper1 *= select;
    select -= lower1 + upper1;
    lower2 *= select;
    upper2 *= select;
    missed = select - lower2 - upper2;
    // Weighted sums of the ends. Weights are 0 and 1 and everything is finite, so that the sums are exact; the ratio
    // is formed after the selection, of one edge alone, and no parallel edge can make it infinite.
    float from_lower = normal + lower1 + lower2 + missed, from_upper = upper1 + upper2;
    a = from_lower * p[0] + from_upper * p[1];
    b = (normal + missed) * p[1] + lower1 * p[2] + upper1 * p[3] + lower2 * p[4] + upper2 * p[5];
    depth_a = from_lower * depth[0] + from_upper * depth[1];
    depth_b = (normal + missed) * depth[1] + lower1 * depth[2] + upper1 * depth[3] + lower2 * depth[4] +
              upper2 * depth[5];
    texture_a = from_lower * vector_at(base + 18) + from_upper * vector_at(base + 21);
    texture_b = (normal + missed) * vector_at(base + 21) + lower1 * vector_at(base + 24) +
                upper1 * vector_at(base + 27) + lower2 * vector_at(base + 30) + upper2 * vector_at(base + 33);
  }
  vec2 weights = edge_weights(depth_a - plane, depth_b - plane);
  // "Nowhere": all six vertices of the prism in one point beside the picture.
  gl_Position = missed > .5 ? vec4(4., 4., .5, 1.) : on_plane(on_edge(weights, a, b), plane);
  out_texture = on_edge(weights, texture_a, texture_b);
}
