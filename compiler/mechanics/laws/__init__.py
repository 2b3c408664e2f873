"""Laws of liaisons: one file a law, and their friction as elements of the kernel."""
