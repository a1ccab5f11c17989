// One triangle over the whole target.
void main() { gl_Position = vec4(VM_VERTEX == 1 ? 3. : -1., VM_VERTEX == 2 ? 3. : -1., 0., 1.); }
