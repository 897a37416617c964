#include "io/settings_yaml.hpp"

#include "io/settings_text.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace riesel::io {
namespace {

// Settings need three levels; the limit keeps hostile files from exhausting the stack.
constexpr std::size_t deepest_nesting = 8;

/// Marks of yaml-cpp count bytes from 0, and are -1 where the position is unknown.
std::size_t offset_of(const YAML::Mark& mark) {
  return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos);
}

YamlNode make_node(YamlNode::Shape shape, Place place, std::string scalar = "") {
  YamlNode node;
  node.shape = shape;
  node.place = std::move(place);
  node.scalar = std::move(scalar);
  return node;
}

/// yaml-cpp itself lets the end of the file close a quote.
bool quote_is_closed(std::string_view text, std::size_t opening) {
  const char quote = text[opening];
  const char escape = quote == '"' ? '\\' : '\'';  // 'it''s'
  for (std::size_t i = opening + 1; i < text.size(); ++i) {
    const bool escapes_quote = i + 1 < text.size() && text[i + 1] == quote;
    if (text[i] == escape && (quote == '"' || escapes_quote)) {
      ++i;
    } else if (text[i] == quote) {
      return true;
    }
  }
  return false;
}

/// Builds the tree from the parser's events and refuses what does not belong in a settings file.
class TreeBuilder : public YAML::EventHandler {
public:
  /// All nodes get the place `everywhere`, if given, instead of their own.
  TreeBuilder(std::string_view text, std::string source, std::optional<Place> everywhere)
      : text_(text), finder_(text, std::move(source)), everywhere_(std::move(everywhere)) {}

  Place place_of(const YAML::Mark& mark) {
    return everywhere_ ? *everywhere_ : finder_.at(offset_of(mark));
  }

  /// The whole tree; nothing if there was no document.
  std::optional<YamlNode> take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_) refuse(mark, "a second document begins here", "give each run a file of its own");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    // The mark of an empty value is that of whatever follows; the key's place helps more.
    const bool is_value = !open_.empty() && open_.back().key;
    const auto place = is_value ? open_.back().key->key_place : place_of(mark);
    place_node(make_node(YamlNode::Shape::null, place), mark);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "aliases (*name) are not supported", "write the value out");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    const auto offset = offset_of(mark);
    const bool is_quoted = offset < text_.size() && (text_[offset] == '"' || text_[offset] == '\'');
    if (is_quoted && !quote_is_closed(text_, offset)) {
      refuse(mark, "this quote is never closed", "close it");
    }
    place_node(make_node(YamlNode::Shape::scalar, place_of(mark), value), mark);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Shape::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Shape::map, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

private:
  /// A list or map whose end has not been seen.
  struct Open {
    YamlNode node;
    YAML::Mark mark;
    std::optional<YamlEntry> key;    ///< waits for its value
    std::set<std::string> all_keys;  ///< seen in this map
  };

  void open(YamlNode::Shape shape, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    if (open_.size() >= deepest_nesting) {
      refuse(mark, fmt::format("nested more than {} levels deep", deepest_nesting),
             "reduce the nesting: above a key there are at most two levels of sections");
    }
    open_.push_back({make_node(shape, place_of(mark)), mark, {}, {}});
  }

  void close() {
    auto closed = std::move(open_.back());
    open_.pop_back();
    place_node(std::move(closed.node), closed.mark);
  }

  /// Puts a finished node where it belongs: in the innermost open list or map, as a key or value,
  /// or at the root.
  void place_node(YamlNode node, const YAML::Mark& mark) {
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (auto& parent = open_.back(); parent.node.shape == YamlNode::Shape::list) {
      parent.node.items.push_back(std::move(node));
    } else if (parent.key) {
      parent.key->value = std::move(node);
      parent.node.entries.push_back(std::move(*parent.key));
      parent.key.reset();
    } else {
      begin_entry(parent, node, mark);
    }
  }

  void begin_entry(Open& map, const YamlNode& key, const YAML::Mark& mark) {
    if (key.shape != YamlNode::Shape::scalar) {
      refuse(mark, fmt::format("expected the name of a setting, got {}", describe(key)),
             "write 'name: value'");
    }
    if (key.scalar == "<<")
      refuse(mark, "merge keys (<<) are not supported", "write the values out");
    if (!map.all_keys.insert(key.scalar).second) refuse_duplicate(map, key);
    map.key = YamlEntry{key.scalar, key.place, {}};
  }

  [[noreturn]] void refuse_duplicate(const Open& map, const YamlNode& key) const {
    auto first = map.node.entries.begin();
    while (first->key != key.scalar) ++first;
    throw SettingsError(key.place, path() + key.scalar,
                        fmt::format("is given twice, first at {}", to_string(first->key_place)),
                        "remove one of the two");
  }

  /// "contact." inside the map of contact.
  std::string path() const {
    std::string path;
    for (const auto& level : open_) {
      if (level.key) path += level.key->key + ".";
    }
    return path;
  }

  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      refuse(mark, "anchors (&name) are not supported", "remove the anchor and write values out");
    }
  }

  /// The parser says "?" for plain and "!" for quoted scalars that have no tag.
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(mark, fmt::format("tags such as {} are not supported", quoted(tag)), "remove the tag");
    }
  }

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& problem,
                           const std::string& remedy) {
    throw SettingsError(place_of(mark), "", problem, remedy);
  }

  std::string_view text_;
  PlaceFinder finder_;
  std::optional<Place> everywhere_;
  std::vector<Open> open_;
  std::optional<YamlNode> root_;
};

/// The tree of the one document in the text; nothing if there is none.
std::optional<YamlNode> parse(const std::string& text, const std::string& source,
                              const std::optional<Place>& everywhere) {
  const auto clean = clean_settings_text(text, source);
  TreeBuilder builder(clean, source, everywhere);
  try {
    std::istringstream stream(clean);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw SettingsError(builder.place_of(error.mark), "",
                        fmt::format("not valid YAML ({})", error.msg),
                        "check the colons, brackets, quotes and indentation up to here");
  }
  return builder.take_root();
}

}  // namespace

YamlNode parse_settings_yaml(const std::string& text, const std::string& source,
                             const std::string& beginning) {
  const auto root = parse(text, source, {});
  if (!root || root->shape == YamlNode::Shape::null) {
    throw SettingsError({source, 1, 1}, "", "the file is empty", "begin with " + beginning);
  }
  if (root->shape != YamlNode::Shape::map) {
    throw SettingsError(root->place, "", fmt::format("expected settings, got {}", describe(*root)),
                        "write lines such as 'scenario: periodic_tube'");
  }
  return *root;
}

YamlNode parse_yaml_value(const std::string& text, const Place& place) {
  return parse(text, to_string(place), place).value_or(make_node(YamlNode::Shape::null, place));
}

YamlNode scalar_node(const Place& place, std::string text) {
  return make_node(YamlNode::Shape::scalar, place, std::move(text));
}

const YamlEntry* find_entry(const YamlNode& map, const std::string& key) {
  const auto entry = std::ranges::find(map.entries, key, &YamlEntry::key);
  return entry == map.entries.end() ? nullptr : &*entry;
}

std::string describe(const YamlNode& node) {
  switch (node.shape) {
  case YamlNode::Shape::null:
    return "nothing";
  case YamlNode::Shape::scalar:
    return quoted(node.scalar);
  case YamlNode::Shape::list:
    return "a list";
  case YamlNode::Shape::map:
    return "a map";
  }
  return {};
}

}  // namespace riesel::io
