"""What is told of expressions and their patterns without knowing what these stand for."""
