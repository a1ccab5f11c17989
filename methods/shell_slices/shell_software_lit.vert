// The whole program is shell_software.vert, which stands in front of this line, with VM_SHELL_LIT.
