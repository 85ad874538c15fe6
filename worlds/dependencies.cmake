stereobench_need(libyaml-cpp-dev yaml-cpp)
