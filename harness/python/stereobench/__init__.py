"""Python modules of stereobench, a stereo simulation testbench."""
