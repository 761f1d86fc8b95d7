// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/similarity_file.hpp"

#include <string_view>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

std::vector<double> numbers_of(const std::string& name, std::size_t line, std::string_view rest) {
  std::vector<double> values;
  while (!rest.empty() && values.size() < 9) values.push_back(word_number(name, line, take_word(rest)));
  return values;
}

}  // namespace

Similarity parse_similarity(const std::string& name, const std::string& text) {
  std::vector<double> v;
  for_each_line(name, text, [&](std::size_t line, std::string_view rest) {
    for (const double value : numbers_of(name, line, rest)) v.push_back(value);
    if (v.size() > 8) fail_line(name, line, "there are more than the 8 numbers s tx ty tz qx qy qz qw");
  });
  if (v.size() != 8) {
    throw InputError(name, "must be \"s tx ty tz qx qy qz qw\", holds " + std::to_string(v.size()) + " numbers");
  }
  if (!(v[0] > 0.0)) throw InputError(name, "the scale must be positive");
  try {
    return {v[0], SE3(rotation_from_text({v[7], v[4], v[5], v[6]}), Eigen::Vector3d(v[1], v[2], v[3]))};
  } catch (const InputError& e) {
    throw InputError(name, e.what());
  }
}

std::string similarity_text(const Similarity& similarity) {
  const Eigen::Vector3d& t = similarity.T_target_source.translation();
  const Eigen::Quaterniond& q = similarity.T_target_source.rotation();
  return formatted("%.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g", similarity.scale, t.x(), t.y(), t.z(), q.x(),
                   q.y(), q.z(), q.w());
}

PointPairs parse_point_pairs(const std::string& name, const std::string& text) {
  PointPairs pairs;
  for_each_line(name, text, [&](std::size_t line, std::string_view rest) {
    const std::vector<double> v = numbers_of(name, line, rest);
    if (v.size() != 6) fail_line(name, line, "expected the 6 numbers x y z X Y Z");
    pairs.source.emplace_back(v[0], v[1], v[2]);
    pairs.target.emplace_back(v[3], v[4], v[5]);
  });
  return pairs;
}

}  // namespace odosplat
