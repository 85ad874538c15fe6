/// Tests on what renders in software, each on machines that have its library.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "renderer/backend.h"
#include "renderer/gl/context_osmesa.h"
#include "tests/renderer/frames.h"

namespace stereobench::renderer::test {

/// @param backend kOsmesa or kEgl
/// @return whether this machine has its library, which may still not render
inline bool has_library(Backend backend) {
  return backend == Backend::kOsmesa ? has_osmesa() : ::dlopen("libEGL.so.1", RTLD_LAZY) != nullptr;
}

/// Skips a test on machines without the library of one of these back ends.
class OnMachinesWith : public testing::Test {
 protected:
  void need(Backend backend) {
    if (!has_library(backend)) GTEST_SKIP() << "no library of " << name_of(backend) << " on this machine";
  }
};

/// A test of each of the back ends in software.
class EachInSoftware : public OnMachinesWith, public testing::WithParamInterface<Backend> {
 protected:
  void SetUp() override { need(GetParam()); }
};

inline const auto kInSoftware = testing::Values(Backend::kOsmesa, Backend::kEgl);

/// A test of the two side by side.
class BothInSoftware : public OnMachinesWith {
 protected:
  void SetUp() override {
    need(Backend::kOsmesa);
    if (!IsSkipped()) need(Backend::kEgl);
  }
};

}  // namespace stereobench::renderer::test
