// What the fragment knows of its place: window x, y, depth, and 1 on front faces, 2 on back faces.
layout(location = 0) in vec4 v_colour;
layout(location = 0) out vec4 out_colour;
void main() { out_colour = vec4(gl_FragCoord.xyz, gl_FrontFacing ? 1.0 : 2.0); }
