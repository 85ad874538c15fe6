stereobench_need(libeigen3-dev Eigen3)
stereobench_need(libceres-dev Ceres)
stereobench_need_library(libsuitesparse-dev ccolamd)
stereobench_need_module(libsleef-dev SLEEF sleef)
