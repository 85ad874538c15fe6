#include "harness/trajectories/trajectory_file.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/trajectories/paths.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class TrajectoryFile : public testing::Test {
 protected:
  Trajectory read(const std::string& text) const {
    folder_.write("path.txt", text);
    return read_trajectory(folder_.path() / "path.txt");
  }
  void expect_refused(const std::string& text, const std::string& why) const {
    EXPECT_THAT([&] { read(text); }, ThrowsMessage<std::runtime_error>(HasSubstr(why))) << text;
  }
  const TestFolder folder_;
};

// One pose, in all formats that hold it. Mutations: the real part of a quaternion in another place; rows for
// columns.
TEST_F(TrajectoryFile, ReadsTheSamePoseOfEveryFormat) {
  const Eigen::Quaterniond q(0.5, 0.1, -0.7, 0.5);
  const Eigen::Quaterniond n = q.normalized();
  const Eigen::Matrix3d r = n.toRotationMatrix();
  const std::string tum = fmt::format("# comment\n\n12.5 1 2 3 {} {} {} {}\n", n.x(), n.y(), n.z(), n.w());
  const std::string euroc = fmt::format("#timestamp,p\n12500000000, 1, 2, 3, {}, {}, {}, {}, 9, 9,\r\n",
                                        n.w(), n.x(), n.y(), n.z());
  const std::string kitti = fmt::format("{} {} {} 1 {} {} {} 2 {} {} {} 3", r(0, 0), r(0, 1), r(0, 2),
                                        r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  for (const std::string& text : {tum, euroc, kitti}) {
    const Trajectory path = read(text);
    ASSERT_EQ(path.poses.size(), 1U) << text;
    EXPECT_TRUE(path.poses[0].rotation.isApprox(r, 1e-12)) << text;
    EXPECT_EQ(path.poses[0].position_m, Eigen::Vector3d(1.0, 2.0, 3.0)) << text;
    EXPECT_FALSE(path.is_planar);
  }
  EXPECT_EQ(read(tum).stamps_ns, std::vector<std::int64_t>{12'500'000'000});
  EXPECT_EQ(read(euroc).stamps_ns, std::vector<std::int64_t>{12'500'000'000});
  EXPECT_TRUE(read(kitti).stamps_ns.empty());
}

TEST_F(TrajectoryFile, PassesOverAMarkOfByteOrderAndAHeader) {
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "1 0 0 0 0 0 0 1\n")
                .poses.size(),
            1U);
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "t_s,x_m,y_m,theta_rad\n0,1,2,0\n")
                .poses.size(),
            1U);
  EXPECT_EQ(read("timestamp,x,y,z,qw,qx,qy,qz\n5,0,0,0,1,0,0,0\n").stamps_ns, std::vector<std::int64_t>{5});
}

TEST_F(TrajectoryFile, ReadsPosesInThePlane) {
  const Trajectory path = read("t_s,x_m,y_m,theta_rad\n0.5,1,2,1.5707963267948966\n");
  EXPECT_TRUE(path.is_planar);
  EXPECT_TRUE(path.poses[0].rotation.isApprox(turned(M_PI / 2.0, {0.0, 0.0, 1.0}), 1e-12));
  EXPECT_EQ(path.poses[0].position_m, Eigen::Vector3d(1.0, 2.0, 0.0));
}

// Mutation: a time that stands still let through.
TEST_F(TrajectoryFile, RefusesInOneLine) {
  expect_refused("", "expected a trajectory: 8 numbers a line (TUM), 12 (KITTI)");
  expect_refused("1 2 3\n", "expected a trajectory");
  expect_refused("t_s,x_m,y_m,theta_rad\n", "expected at least one pose");
  expect_refused("5e9 0 0 0 0 0 0 1\n", "path.txt:1: time: expected a time within 4e9 seconds");
  expect_refused("1,0,0,0,1,0,0,0\n2,0,0,0,1,0,0,0\n", "path.txt:2: time: expected nanoseconds (EuRoC)");
  expect_refused("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n",
                 "path.txt:2: expected 8 fields (time, x, y, z, qx, qy, qz, qw), found 7");
  expect_refused("1 0 0 0 0 0 0 nan\n", "path.txt:1: qw: expected a finite number, found 'nan'");
  expect_refused("1 0 0 0 0 0 0 1.2\n", "path.txt:1: qw: expected a quaternion of length 1, found '1.2'");
  expect_refused("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n",
                 "path.txt:2: time: expected a time after the line above");
  expect_refused("1.5,0,0,0,1,0,0,0\n", "expected a time as a whole number of nanoseconds, found '1.5'");
  expect_refused("1 0 0 0 0 2 0 0 0 0 1 0\n", "path.txt:1: r11: expected a rotation");
  expect_refused("-1 0 0 0 0 1 0 0 0 0 1 0\n", "expected a rotation");
  EXPECT_THAT([&] { read_trajectory(folder_.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("expected a file, not a folder or a pipe")));
  EXPECT_THAT([&] { read_trajectory(folder_.path() / "none.txt"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none.txt[.gz]: no such file")));
}

}  // namespace
}  // namespace stereobench::harness
