// What the loop over bonds fetches of a particle lies together: its motion in one record, its sums
// in another. An end of a bond then costs three lines of the cache where five columns cost five
// (data/performance).
#pragma once
#include <algorithm>
#include <utility>

#include "core/tables/column.hpp"
#include "core/tables/column_storage.hpp"
#include "kernels/math/strided.hpp"

namespace breccia {

/// One quantity of the particles in their records; read and written like a column. Made by its
/// records only.
class RecordField {
public:
  using value_type = Vec3;

  RecordField(const RecordField&) = delete;
  RecordField& operator=(const RecordField&) = delete;

  Vec3& operator[](std::size_t row) { return rows_[row]; }
  const Vec3& operator[](std::size_t row) const { return rows_[row]; }
  std::size_t size() const { return rows_.size(); }
  bool empty() const { return rows_.empty(); }
  auto begin() { return rows_.begin(); }
  auto end() { return rows_.end(); }
  auto begin() const { return Strided<const Vec3>(rows_).begin(); }
  auto end() const { return Strided<const Vec3>(rows_).end(); }
  operator Strided<Vec3>() { return rows_; }
  operator Strided<const Vec3>() const { return rows_; }

  Column<Vec3> copy() const { return {begin(), end()}; }
  /// @param values  one for each row
  void fill(Strided<const Vec3> values) { std::copy(values.begin(), values.end(), begin()); }
  bool operator==(const RecordField& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

private:
  friend struct ParticleRecords;
  RecordField() = default;
  Strided<Vec3> rows_;
};

/// Records of motion (position, velocity and, where particles turn, spin) and of sums (force and
/// torque).
struct ParticleRecords {
  RecordField position, velocity, spin;
  RecordField force, torque;

  ParticleRecords() = default;
  ParticleRecords(const ParticleRecords& other)
      : turn_(other.turn_), motion_(other.motion_), sums_(other.sums_) {
    bind();
  }
  ParticleRecords(ParticleRecords&& other) noexcept { swap(other); }
  ParticleRecords& operator=(ParticleRecords other) noexcept {
    swap(other);
    return *this;
  }

  /// All of them zero.
  void resize_records(std::size_t rows, bool turn) {
    turn_ = turn;
    motion_.assign(rows * motion_stride(), {});
    sums_.assign(rows * sums_stride(), {});
    bind();
  }

  /// Rows of sums beyond those of the particles; those that are there keep their values.
  void extend_sums(std::size_t rows) {
    sums_.resize(rows * sums_stride());
    bind();
  }

private:
  std::size_t motion_stride() const { return turn_ ? 3 : 2; }
  std::size_t sums_stride() const { return turn_ ? 2 : 1; }

  void bind() {
    const auto field = [](Column<Vec3>& records, std::size_t place, std::size_t stride, bool there) {
      return there && !records.empty()
                 ? Strided<Vec3>(records.data() + place, records.size() / stride, stride)
                 : Strided<Vec3>();
    };
    position.rows_ = field(motion_, 0, motion_stride(), true);
    velocity.rows_ = field(motion_, 1, motion_stride(), true);
    spin.rows_ = field(motion_, 2, motion_stride(), turn_);
    force.rows_ = field(sums_, 0, sums_stride(), true);
    torque.rows_ = field(sums_, 1, sums_stride(), turn_);
  }

  void swap(ParticleRecords& other) noexcept {
    std::swap(turn_, other.turn_);
    motion_.swap(other.motion_);
    sums_.swap(other.sums_);
    bind();
    other.bind();
  }

  bool turn_ = false;
  Column<Vec3> motion_, sums_;
};

}  // namespace breccia
