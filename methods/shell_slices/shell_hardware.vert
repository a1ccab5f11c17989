// One of the six vertices of a prism on a plane, which finds its own place (lensch2002, section 6, Figure 5; which of
// two crossed edges is taken: hardware_edge() in section.h).
VM_SPEC(6, VM_BRANCHES, 0)  // 0: everything is computed and selected by weights of 0 and 1; 1: if
VM_SPEC(7, VM_LISTED, 0)    // 1: the pairs of prism and plane are listed; 0: every prism on the plane of the instance

// 36 floats a vertex. Positions: own lower and upper, primary lower and upper, secondary lower and upper; then the
// texture coordinates of these.
layout(std430, binding = 5) readonly buffer Corners { float corners[]; };
layout(std430, binding = 6) readonly buffer Pairs { uvec2 pairs[]; };

#ifdef VM_SHELL_LIT
// 54 floats a vertex: the cotangents of the six corners.
layout(std430, binding = 7) readonly buffer Cotangents { float cotangents[]; };

vec3 column_at(int i) { return vec3(cotangents[i], cotangents[i + 1], cotangents[i + 2]); }
#endif

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
#ifdef VM_SHELL_LIT
  vec3 u_a, u_b, v_a, v_b, w_a, w_b;
  int own = 54 * vertex;
#endif
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
#ifdef VM_SHELL_LIT
    u_a = column_at(own + 9 * ends.x);
    u_b = column_at(own + 9 * ends.y);
    v_a = column_at(own + 9 * ends.x + 3);
    v_b = column_at(own + 9 * ends.y + 3);
    w_a = column_at(own + 9 * ends.x + 6);
    w_b = column_at(own + 9 * ends.y + 6);
#endif
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
    float from_lower = normal + lower1 + lower2 + missed, from_upper = upper1 + upper2, across = normal + missed;
    a = from_lower * p[0] + from_upper * p[1];
    b = across * p[1] + lower1 * p[2] + upper1 * p[3] + lower2 * p[4] + upper2 * p[5];
    depth_a = from_lower * depth[0] + from_upper * depth[1];
    depth_b = across * depth[1] + lower1 * depth[2] + upper1 * depth[3] + lower2 * depth[4] +
              upper2 * depth[5];
    texture_a = from_lower * vector_at(base + 18) + from_upper * vector_at(base + 21);
    texture_b = across * vector_at(base + 21) + lower1 * vector_at(base + 24) +
                upper1 * vector_at(base + 27) + lower2 * vector_at(base + 30) + upper2 * vector_at(base + 33);
#ifdef VM_SHELL_LIT
    u_a = v_a = w_a = u_b = v_b = w_b = vec3(0.);
    float from[6] = float[6](from_lower, from_upper, 0., 0., 0., 0.);
    float to[6] = float[6](0., across, lower1, upper1, lower2, upper2);
    for (int i = 0; i < 6; ++i) {
      vec3 u = column_at(own + 9 * i), v = column_at(own + 9 * i + 3), w = column_at(own + 9 * i + 6);
      u_a += from[i] * u;
      u_b += to[i] * u;
      v_a += from[i] * v;
      v_b += to[i] * v;
      w_a += from[i] * w;
      w_b += to[i] * w;
    }
#endif
  }
  vec2 weights = edge_weights(depth_a - plane, depth_b - plane);
  // "Nowhere": all six vertices of the prism in one point beside the picture.
  vec3 point = on_edge(weights, a, b);
  gl_Position = missed > .5 ? vec4(4., 4., .5, 1.) : on_plane(point, plane);
  out_texture = on_edge(weights, texture_a, texture_b);
#ifdef VM_SHELL_LIT
  out_box = point * (.5 * shell.lens.w) + .5;
  out_gradient_u = on_edge(weights, u_a, u_b);
  out_gradient_v = on_edge(weights, v_a, v_b);
  out_gradient_w = on_edge(weights, w_a, w_b);
#endif
}
