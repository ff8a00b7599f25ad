# Reads the runner's output of a run without the data bundle, in which every test may speak.
# Of tests that passed, only what they say they left out is kept; from the first failure on, everything is.
/FAIL/ { failing = 1 }
/^ *(running [0-9]+ tests?|test .* \.\.\. ok|test result: ok.*|stdout.*|stderr.*)?$/ { next }
/^    / && !failing && !/left out|LEFT OUT|SLOW|Starting|Summary/ { next }
{ print; fflush() }
