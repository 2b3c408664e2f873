"""How long a test waits for another process before it says that it hangs."""

# Seconds. What takes a second on an idle machine may take a minute on one that is lent out.
PATIENCE = 240.0
