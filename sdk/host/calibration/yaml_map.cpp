#include "host/calibration/yaml_map.h"

#include <cmath>
#include <set>

#include "host/cameras/camera_models.h"
#include "host/cameras/fault.h"
#include "host/recording/text_field.h"

namespace sphc::host {
namespace {

constexpr size_t kMostNumbers = 64;

// Appends the finite numbers of `node`; false at anything else.
bool collect(const YAML::Node &node, int depth, std::vector<double> *numbers) {
  if (node.IsScalar()) {
    double value = 0;
    if (!recording::parseDouble(node.Scalar(), value) || !std::isfinite(value)) return false;
    numbers->push_back(value);
    return numbers->size() <= kMostNumbers;
  }
  if (!node.IsSequence() || depth == 0) return false;
  for (const YAML::Node &item : node) {
    if (!collect(item, depth - 1, numbers)) return false;
  }
  return true;
}

}  // namespace

YamlMap::YamlMap(YAML::Node node, std::string file, std::string path)
    : node_(std::move(node)), file_(std::move(file)), path_(std::move(path)) {
  if (!node_.IsMap())
    host::refuse(file_, path_.empty() ? "the file" : path_, "must be keys with values, as in key: value");
  std::set<std::string> seen;
  for (const auto &item : node_) {
    if (!item.first.IsScalar()) continue;
    if (!seen.insert(item.first.Scalar()).second) refuse(shown(item.first.Scalar()), "given twice; remove one");
  }
}

YamlMap YamlMap::parse(const TextFile &file) {
  try {
    return {YAML::Load(file.text), file.name, ""};
  } catch (const YAML::Exception &error) {
    host::refuse(file.name, "line " + std::to_string(error.mark.line + 1),
                 "no valid YAML; correct this line: " + error.msg);
  }
}

bool YamlMap::has(const std::string &key) const {
  const YAML::Node node = std::as_const(node_)[key];
  return node.IsDefined() && !node.IsNull();
}

std::vector<std::string> YamlMap::keys() const {
  std::vector<std::string> result;
  for (const auto &item : node_) {
    if (item.first.IsScalar()) result.push_back(item.first.Scalar());
  }
  return result;
}

YAML::Node YamlMap::require(const std::string &key, const std::string &example) const {
  if (!has(key)) refuse(key, "missing; add it, as in " + key + ": " + example);
  return std::as_const(node_)[key];
}

YamlMap YamlMap::map(const std::string &key) const { return {require(key, "{...}"), file_, path(key)}; }

std::string YamlMap::text(const std::string &key, const std::string &example) const {
  const YAML::Node node = require(key, example);
  if (!node.IsScalar()) refuse(key, "must be a word, as in " + key + ": " + example);
  return node.Scalar();
}

std::vector<double> YamlMap::numbers(const std::string &key, const std::string &example) const {
  std::vector<double> result;
  const YAML::Node node = require(key, example);
  if (!node.IsSequence() || !collect(node, 2, &result))
    refuse(key, "must be a list of at most " + std::to_string(kMostNumbers) + " finite numbers, as in " + example);
  return result;
}

uint32_t YamlMap::pixels(const std::string &key) const {
  const std::string value = text(key, "640");
  uint32_t result = 0;
  if (!recording::parseUnsigned(value, result) || !isImageSide(result))
    refuse(key, "is " + shown(value) + "; " + imageSideCure());
  return result;
}

void YamlMap::refuse(const std::string &key, const std::string &why) const { host::refuse(file_, path(key), why); }

}  // namespace sphc::host
