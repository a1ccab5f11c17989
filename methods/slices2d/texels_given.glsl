// Put in front of fixed_point.glsl: texels come from the pages of a stack.
#define VM_TEXELS_GIVEN
