"""What is told of CasADi expressions without knowing what they stand for."""
