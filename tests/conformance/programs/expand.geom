// A point becomes a triangle strip of four vertices, a square of side 1 in NDC with the point at its lower left.
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;
layout(location = 0) in vec4 v_in[];
layout(location = 0) out vec4 v_colour;
void main() {
  for (int i = 0; i < 4; ++i) {
    gl_Position = gl_in[0].gl_Position + vec4(float(i & 1), float(i >> 1), 0.0, 0.0);
    v_colour = v_in[0];
    EmitVertex();
  }
  EndPrimitive();
}
