/// What the residuals of a rig's fit say beyond their size.
#pragma once

#include <Eigen/Core>

namespace stereobench::harness {

/// Each coordinate's standard deviation by second differences along the board's rows: what is smooth over
/// three corners, as all that a model leaves out is, falls out of them.
/// @param residuals px, by view, corner (row by row), camera, axis
/// @param columns of a board
double neighbour_sd(const Eigen::VectorXd& residuals, int columns);

/// How much errors of one view hang together: by how much sums along the board's rows and columns scatter
/// more, as variances, than those of errors that do not (a design effect).
/// @return at least 1
double clustering(const Eigen::VectorXd& residuals, int columns, int rows);

}  // namespace stereobench::harness
