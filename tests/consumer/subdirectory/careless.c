/* Code of the other project, which warns where our own warnings are on. */
static int never_called(int unused) { return 0; }
