"""What names stand for: classes, scopes, modifiers, imported files."""
