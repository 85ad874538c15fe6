#include "worlds/generate/lattice.h"

#include <algorithm>
#include <array>
#include <map>

namespace stereobench::worlds {
namespace {

using Eigen::Vector2i;

const std::array<Vector2i, 4> kWays = {Vector2i(1, 0), Vector2i(0, 1), Vector2i(-1, 0), Vector2i(0, -1)};

int below(slam::RandomStream& draws, std::size_t count) {
  return static_cast<int>(draws.uniform() * static_cast<double>(count));
}

/// Cells of the lattice that are marked; none is outside.
class Marks {
 public:
  Marks(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        marks_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  bool has(const Vector2i& cell) const { return inside(cell) && marks_[index(cell)]; }
  void set(const Vector2i& cell, bool mark) { marks_[index(cell)] = mark; }
  bool inside(const Vector2i& cell) const {
    return cell.minCoeff() >= 0 && cell.x() < columns_ && cell.y() < rows_;
  }
  std::size_t size() const { return marks_.size(); }
  std::size_t index(const Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.x());
  }
  Vector2i cell(std::size_t index) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
  }

 private:
  int columns_;
  int rows_;
  std::vector<bool> marks_;
};

/// The outline of the marked cells as a way along the lattice's lines; empty when it is not one simple loop.
std::vector<Vector2i> outline(const Marks& marks) {
  std::map<std::pair<int, int>, Vector2i> next;
  std::size_t edges = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Vector2i cell = marks.cell(i);
    if (!marks.has(cell)) continue;
    const std::array<Vector2i, 4> corners = {cell, cell + Vector2i(1, 0), cell + Vector2i(1, 1),
                                             cell + Vector2i(0, 1)};
    const std::array<Vector2i, 4> across = {Vector2i(0, -1), Vector2i(1, 0), Vector2i(0, 1), Vector2i(-1, 0)};
    for (std::size_t side = 0; side < 4; ++side) {
      if (marks.has(cell + across[side])) continue;
      ++edges;
      next.emplace(std::pair(corners[side].x(), corners[side].y()), corners[(side + 1) % 4]);
    }
  }
  if (edges == 0 || next.size() != edges) return {};  // two edges from one point: it touches itself
  const Vector2i start(next.begin()->first.first, next.begin()->first.second);
  std::vector<Vector2i> way;
  for (Vector2i at = start; way.empty() || at != start; at = next.at({at.x(), at.y()})) way.push_back(at);
  return way.size() == edges ? way : std::vector<Vector2i>{};  // else there is a hole
}

std::vector<Vector2i> farthest_way(const Vector2i& start, const std::vector<std::vector<Vector2i>>& open,
                                   const Marks& lattice) {
  std::vector<int> from(lattice.size(), -1);
  std::vector<Vector2i> reached = {start};
  from[lattice.index(start)] = static_cast<int>(lattice.index(start));
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const Vector2i& cell : open[lattice.index(reached[i])]) {
      if (from[lattice.index(cell)] >= 0) continue;
      from[lattice.index(cell)] = static_cast<int>(lattice.index(reached[i]));
      reached.push_back(cell);
    }
  }
  std::vector<Vector2i> way = {reached.back()};
  while (way.back() != start)
    way.push_back(lattice.cell(static_cast<std::size_t>(from[lattice.index(way.back())])));
  return way;
}

}  // namespace

std::vector<Vector2i> random_loop(int columns, int rows, int turns, slam::RandomStream& draws) {
  Marks marks(columns, rows);
  marks.set(marks.cell(static_cast<std::size_t>(below(draws, marks.size()))), true);
  const auto touches = [&](const Vector2i& cell) {
    return std::ranges::any_of(kWays, [&](const Vector2i& way) { return marks.has(cell + way); });
  };
  for (std::size_t attempt = 0; attempt < 40 * marks.size(); ++attempt) {
    const std::vector<Vector2i> corners = corners_of(outline(marks), true);
    if (static_cast<int>(corners.size()) >= turns && attempt >= marks.size()) return corners;
    const Vector2i cell = marks.cell(static_cast<std::size_t>(below(draws, marks.size())));
    const bool was = marks.has(cell);
    if (!was && !touches(cell)) continue;
    marks.set(cell, !was);
    if (outline(marks).empty()) marks.set(cell, was);
  }
  return {};
}

std::vector<Passage> random_tree(int columns, int rows, slam::RandomStream& draws) {
  Marks visited(columns, rows);
  std::vector<Passage> passages;
  std::vector<Vector2i> stack = {visited.cell(static_cast<std::size_t>(below(draws, visited.size())))};
  visited.set(stack.back(), true);
  while (!stack.empty()) {
    std::vector<Vector2i> free;
    for (const Vector2i& way : kWays) {
      const Vector2i cell = stack.back() + way;
      if (visited.inside(cell) && !visited.has(cell)) free.push_back(cell);
    }
    if (free.empty()) {
      stack.pop_back();
      continue;
    }
    const Vector2i chosen = free[static_cast<std::size_t>(below(draws, free.size()))];
    passages.emplace_back(stack.back(), chosen);
    visited.set(chosen, true);
    stack.push_back(chosen);
  }
  return passages;
}

std::vector<Vector2i> longest_way(int columns, int rows, const std::vector<Passage>& passages) {
  const Marks lattice(columns, rows);
  std::vector<std::vector<Vector2i>> open(lattice.size());
  for (const auto& [a, b] : passages) {
    open[lattice.index(a)].push_back(b);
    open[lattice.index(b)].push_back(a);
  }
  return farthest_way(farthest_way({0, 0}, open, lattice).front(), open, lattice);
}

std::vector<Vector2i> corners_of(const std::vector<Vector2i>& way, bool closed) {
  std::vector<Vector2i> corners;
  const std::size_t n = way.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = !closed && (i == 0 || i + 1 == n);
    const Vector2i in = way[i] - way[(i + n - 1) % n];
    const Vector2i out = way[(i + 1) % n] - way[i];
    if (end || in != out) corners.push_back(way[i]);
  }
  return corners;
}

}  // namespace stereobench::worlds
