// The whole program is shell_slices.frag, which stands in front of this line, with VM_SHELL_LIT.
