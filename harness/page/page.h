/// A page of results as a value: blocks of a few kinds, one below the other.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace stereobench::harness {

/// How a cell is coloured.
enum class CellMark { kNone, kGood, kBad, kUnsure };

/// A change with its interval, all in units of the margin: positive is worse.
struct PageInterval {
  double low = 0.0;
  double value = 0.0;
  double high = 0.0;
};

/// A cell of a table.
struct PageCell {
  std::string text = {};
  std::optional<double> number = {};  ///< what the column is sorted by; none: by the text
  CellMark mark = CellMark::kNone;
  std::string link = {};                      ///< identity of a block of the page; empty: no link
  std::optional<PageInterval> interval = {};  ///< drawn in place of the text
};

struct PageRow {
  std::vector<PageCell> cells;
  bool is_quiet = false;  ///< shown on demand only
};

/// A table that the reader sorts by any column.
struct PageTable {
  std::vector<std::string> header;
  std::vector<PageRow> rows;   ///< each as long as the header
  std::string quiet = "more";  ///< what quiet rows are called on the button that shows them
};

/// How a series is drawn.
enum class Look { kLine, kDashes, kPoints, kBand };

/// Numbers over numbers. What is not finite is left out, and interrupts a line.
struct Series {
  std::string name;
  Look look = Look::kLine;
  std::vector<double> x;
  std::vector<double> y;     ///< as long as x; empty for a band
  std::vector<double> low;   ///< as long as x, or empty: of the interval of each point, or of the band
  std::vector<double> high;  ///< the same
};

struct Chart {
  std::string name;     ///< in the menu where a block has several
  std::string x_label;  ///< with its unit
  std::string y_label;
  bool x_is_logarithmic = false;
  bool y_is_logarithmic = false;
  std::vector<std::string> x_names = {};  ///< of x = 0, 1, ... where they are not numbers
  std::vector<Series> series = {};
};

/// One chart, or several of which the reader chooses one.
struct PageCharts {
  std::vector<Chart> charts;
};

/// What a map shows of one estimator. Frame: the truth's, metres.
struct PageEstimate {
  std::string name;
  std::vector<Eigen::Vector2d> path;         ///< one an instant, or fewer
  std::vector<Eigen::Matrix2d> covariances;  ///< m^2, one for each of the path; empty where there are none
  struct Landmark {
    Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    std::optional<std::size_t> true_one;  ///< index into PageMap::landmarks
  };
  std::vector<Landmark> landmarks;  ///< at the end
};

/// A plan with a slider of time. Metres, x to the right, y upwards.
struct PageMap {
  std::vector<double> time_s;                         ///< of each instant
  std::vector<std::vector<Eigen::Vector2d>> walls;    ///< lines
  std::vector<std::optional<Eigen::Vector3d>> truth;  ///< x, y, heading, one an instant
  std::vector<std::vector<Eigen::Vector2d>>
      sightings;  ///< where they are, from the true pose; one an instant
  struct Landmark {
    Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
    std::string colour;  ///< "#rrggbb"; empty: it has none
  };
  std::vector<Landmark> landmarks;
  std::vector<PageEstimate> estimates;
};

/// What became of a ball or a detection.
enum class Fate { kFound, kMissed, kWrong, kFalse, kOther };

/// An outline of a ball in a picture, where the truth has it.
struct TrueOutline {
  std::vector<Eigen::Vector2d> corners_px;  ///< closed
  std::string label;
  Fate fate = Fate::kOther;
};

/// A detection's centre in a picture.
struct SeenCentre {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  std::string label;
  Fate fate = Fate::kFound;
};

/// A picture with what is drawn over it.
struct FramePanel {
  std::string title;
  std::optional<std::size_t> picture;  ///< index into PageFrames::jpegs; none: no picture was kept
  std::vector<TrueOutline> truth;
  std::vector<SeenCentre> detections;
};

struct PageFrame {
  std::string title;
  std::string note;     ///< what is wrong with it
  std::string command;  ///< that writes its pictures and truth
  std::vector<FramePanel> panels;
};

/// Pictures to leaf through with arrow keys, with overlays that are switched on and off.
struct PageFrames {
  int width_px = 0;  ///< of the cameras; pictures may be smaller, and are drawn as large
  int height_px = 0;
  std::vector<std::string> jpegs;
  std::vector<PageFrame> frames;
};

/// Lines of text.
struct PageText {
  std::vector<std::string> lines;
};

/// A part of a page.
struct Block {
  std::string title;
  std::string note;                        ///< how to read it
  std::vector<std::string> commands = {};  ///< command lines that make it
  std::string identity = {};               ///< that cells link to; empty: none does
  bool is_chapter = false;                 ///< the title is one of a chapter: blocks follow that belong to it
  std::variant<PageText, PageTable, PageCharts, PageMap, PageFrames> content = PageText{};
};

struct Page {
  std::string title;
  std::vector<std::string> facts;  ///< some words each, below the title
  std::vector<Block> blocks;
};

/// The page as one HTML file, with all that it needs inside. Equal pages give equal bytes.
///
/// Texts are shown as they are: nothing in them is taken for HTML. Bytes that are no UTF-8 are replaced.
/// @throws std::invalid_argument when a row is not as long as its header, or a series' numbers are not as
/// many as each other
std::string page_html(const Page& page);

}  // namespace stereobench::harness
