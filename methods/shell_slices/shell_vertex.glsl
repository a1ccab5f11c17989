// What the vertex programs of shells hand on. With VM_SHELL_LIT (shell_lit.glsl) also what light needs; without it, no
// word of it is compiled.
layout(location = 0) out vec3 out_texture;
#ifdef VM_SHELL_LIT
layout(location = 1) out vec3 out_box;  // position: 0 at -radius, 1 at +radius of the shell
// Columns of the cotangent (scenes/shell.h): gradients of u, v and w in world space, times the radius.
layout(location = 2) out vec3 out_gradient_u;
layout(location = 3) out vec3 out_gradient_v;
layout(location = 4) out vec3 out_gradient_w;
#endif
