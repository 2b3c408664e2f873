"""C compilers, the cache of programs, and the processes that make them."""
