/// Sparse least squares that is solved anew at the cost of what changed: the Bayes tree.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace stereobench::slam {

/// The linear least-squares problem of a factor graph, kept factored by QR (Kaess et al., iSAM2, IJRR 2012).
///
/// Each variable is a node that holds its density given its separator, the variables that are eliminated
/// later and tied to it. A factor that is new or replaced concerns the nodes of its variables and all above
/// them; those are eliminated anew in an order of their own (CCOLAMD), the trees below are hung on again.
///
/// Variables have one to three numbers, and factors concern one variable or two. Equal calls give equal
/// bytes.
class BayesTree {
 public:
  static constexpr int kNone = -1;
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  /// Rows of unit variance: by_first * first + by_second * second = target. Rows and columns beyond what is
  /// used are not read.
  struct Factor {
    int first = kNone;   ///< a variable
    int second = kNone;  ///< another one, or kNone
    int rows = 0;
    Eigen::Matrix3d by_first = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d by_second = Eigen::Matrix3d::Zero();
    Eigen::Vector3d target = Eigen::Vector3d::Zero();
  };

  /// @param guess its solution until something is known of it, and where it is held; the first `numbers` of
  /// it are read
  /// @return the variable's index: they are counted from 0
  int add_variable(int numbers, const Eigen::Vector3d& guess);

  /// @return the factor's index: they are counted from 0
  int add(const Factor& factor);

  /// @param factor of the same variables as the one that it replaces
  void replace(int index, const Factor& factor);

  /// Says where directions of a variable are held of which nothing is known.
  void hold(int variable, const Eigen::Vector3d& at) { node(variable).held = at; }

  const Factor& factor(int index) const { return factors_[static_cast<std::size_t>(index)]; }

  /// @return the factors of a variable whose other variable is eliminated later, if there is one
  std::span<const int> entering_at(int variable) const { return node(variable).factors; }

  /// Factors what was added and replaced since the last call, and finds the solution.
  ///
  /// A variable that would change by less than 10^-2 of its conditional standard deviation stays as it is,
  /// until more has come together. One is solved anew where it was eliminated anew, or where a variable of
  /// its separator has changed. Of the latter some may be left behind, for catch_up().
  ///
  /// @param last variables that the next factors will concern: they are eliminated last
  /// @param most how many variables may be solved anew that were not eliminated anew
  /// @return the variables that were solved anew, changed or not
  std::vector<int> solve(std::span<const int> last, std::size_t most = kAll);

  /// Solves variables anew that were left behind, and what they depend on: none is ever solved before those.
  ///
  /// @return the variables that were solved anew, changed or not
  std::vector<int> catch_up(std::span<const int> variables);

  /// @return the solution of a variable; numbers that it does not have are 0
  const Eigen::Vector3d& solution(int variable) const {
    return followed_.solution[static_cast<std::size_t>(variable)];
  }

  /// @return the solution of all variables, none of them left
  std::vector<Eigen::Vector3d> settled() const;

  /// The joint covariance of variables at the solution, in their order. Exact for the linear problem, and
  /// positive semidefinite by construction. Costs grow with the paths from them to the root.
  ///
  /// @param variables each once; none added since the last solve()
  Eigen::MatrixXd covariance(std::span<const int> variables) const;

  /// How many directions nothing was known of when they were eliminated; they stay where they are held.
  long repairs() const { return repairs_; }

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  struct Node {
    int numbers = 0;
    int rank = kNone;  ///< in the order of elimination; kNone before the first
    int parent = kNone;
    std::vector<int> children;
    std::vector<int> separator;  ///< in the order of elimination as it was then
    std::vector<int> factors;    ///< that entered here
    Rows density;                ///< R, S, d: R x + S separator = d
    Rows passed;                 ///< what is known of the separator from here and below, beside the target
    Eigen::Vector3d held = Eigen::Vector3d::Zero();  ///< where nothing else is known
  };

  /// How far back substitution has come, by variable. Times count solved variables.
  struct Followed {
    std::vector<Eigen::Vector3d> solution;
    std::vector<long> solved;  ///< when it was solved last
    std::vector<long> moved;   ///< when it was changed last
    long time = 0;
  };

  /// What is to be eliminated anew.
  struct Top {
    std::vector<int> variables;  ///< in the order of elimination once that is known
    std::vector<int> factors;
    std::vector<int> orphans;  ///< nodes whose parent is eliminated anew, but not they themselves
  };

  // What column_ says of a variable besides its column.
  static constexpr Eigen::Index kNotMet = -1;
  static constexpr Eigen::Index kTaken = -2;
  Eigen::Index& column_of(int variable) { return column_[static_cast<std::size_t>(variable)]; }

  Node& node(int variable) { return nodes_[static_cast<std::size_t>(variable)]; }
  const Node& node(int variable) const { return nodes_[static_cast<std::size_t>(variable)]; }
  void touch(const Factor& factor);
  Top take_off_top();
  void order(Top& top, std::span<const int> last) const;
  void eliminate(const Top& top);
  void eliminate(int variable, std::span<const int> children);
  Eigen::Index find_separator(int variable, std::span<const int> children);
  Rows assemble(int variable, std::span<const int> children);
  void write(const Factor& factor, Eigen::Index row, Rows& rows);
  void solve_node(int variable, Followed& followed) const;
  bool is_behind(int variable, const Followed& followed) const;
  void follow(std::vector<int> below, std::size_t most, std::vector<int>& solved);
  std::vector<int> ancestors_of(std::span<const int> variables) const;

  std::vector<Node> nodes_;
  std::vector<Factor> factors_;
  Followed followed_;
  std::vector<int> waiting_;  ///< factors that have not entered
  std::vector<int> touched_;  ///< variables of factors that are new or replaced
  int next_rank_ = 0;
  long repairs_ = 0;
  std::vector<Eigen::Index> column_;  ///< scratch, by variable
};

}  // namespace stereobench::slam
