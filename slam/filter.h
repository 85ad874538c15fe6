/// What every filter can do, and a value that holds any of them.
#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "slam/association/decisions.h"
#include "slam/types.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// The contract of a filter: predict with each control, update with each frame, ask. The functions of the
/// same names below say what each does. A copy shares nothing with the original.
template <class T>
concept FilterType = std::copyable<T> &&
    requires(T filter, const T& asked, const Control& control, std::span<const RangeBearing> sightings) {
  filter.predict(control);
  filter.update(sightings);
  { asked.estimate() } -> std::convertible_to<Estimate>;
  { asked.estimate_without_map() } -> std::convertible_to<Estimate>;
  { asked.last_update() } -> std::convertible_to<UpdateReport>;
  { asked.particle_count() } -> std::convertible_to<int>;
  { asked.last_decisions() } -> std::convertible_to<Decisions>;
};

/// Any filter, as a value: a copy goes its own way and shares nothing with the original. One that was moved
/// from can only be assigned to or destroyed.
class Filter {
 public:
  template <class T>
  requires(!std::same_as<std::remove_cvref_t<T>, Filter> && FilterType<std::remove_cvref_t<T>>)
      Filter(T&& filter)
      : held_(std::make_unique<Held<std::remove_cvref_t<T>>>(std::forward<T>(filter))) {}

  Filter(const Filter& other) : held_(other.held_ ? other.held_->clone() : nullptr) {}
  Filter& operator=(const Filter& other) {
    held_ = other.held_ ? other.held_->clone() : nullptr;
    return *this;
  }
  Filter(Filter&&) noexcept = default;
  Filter& operator=(Filter&&) noexcept = default;
  ~Filter() = default;

  /// Moves the belief by one control. One that is not finite or runs backwards in time is ignored and
  /// counted.
  friend void predict(Filter& filter, const Control& control) { filter.held_->predict(control); }

  /// Corrects the belief by what was seen at one instant; an empty frame is none at all. A sighting that is
  /// not finite, has a negative range or an impossible covariance is ignored and counted.
  friend void update(Filter& filter, std::span<const RangeBearing> sightings) {
    filter.held_->update(sightings);
  }

  /// @return what the filter believes now: pose, map and what it had to repair so far
  friend Estimate estimate(const Filter& filter) { return filter.held_->estimate(); }

  /// @return the same without its map, at a cost that does not depend on the map
  friend Estimate estimate_without_map(const Filter& filter) { return filter.held_->estimate_without_map(); }

  /// @return what the last update found out about the filter; empty unless its settings ask for reports
  friend UpdateReport last_update(const Filter& filter) { return filter.held_->last_update(); }

  /// @return how many particles a filter has; 1 for those that are one Gaussian
  friend int particle_count(const Filter& filter) { return filter.held_->particle_count(); }

  /// @return what became of the sightings of the last update; for a filter of many particles, by the one that
  /// the frame left heaviest. Nothing for a filter without a map
  friend Decisions last_decisions(const Filter& filter) { return filter.held_->last_decisions(); }

 private:
  struct Base {
    virtual ~Base() = default;
    virtual std::unique_ptr<Base> clone() const = 0;
    virtual void predict(const Control& control) = 0;
    virtual void update(std::span<const RangeBearing> sightings) = 0;
    virtual Estimate estimate() const = 0;
    virtual Estimate estimate_without_map() const = 0;
    virtual UpdateReport last_update() const = 0;
    virtual int particle_count() const = 0;
    virtual Decisions last_decisions() const = 0;
  };

  template <class T>
  struct Held final : Base {
    template <class U>
    explicit Held(U&& some) : filter(std::forward<U>(some)) {}
    std::unique_ptr<Base> clone() const override { return std::make_unique<Held>(filter); }
    void predict(const Control& control) override { filter.predict(control); }
    void update(std::span<const RangeBearing> sightings) override { filter.update(sightings); }
    Estimate estimate() const override { return filter.estimate(); }
    Estimate estimate_without_map() const override { return filter.estimate_without_map(); }
    UpdateReport last_update() const override { return filter.last_update(); }
    int particle_count() const override { return filter.particle_count(); }
    Decisions last_decisions() const override { return filter.last_decisions(); }

    T filter;
  };

  std::unique_ptr<Base> held_;
};

// Declared once more, so that slam::update(filter, ...) finds them.
void predict(Filter& filter, const Control& control);
void update(Filter& filter, std::span<const RangeBearing> sightings);
Estimate estimate(const Filter& filter);
Estimate estimate_without_map(const Filter& filter);
UpdateReport last_update(const Filter& filter);
int particle_count(const Filter& filter);
Decisions last_decisions(const Filter& filter);

}  // namespace stereobench::slam
