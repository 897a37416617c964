// What a settings file must not be, whatever its settings say: broken text, broken YAML, and the
// parts of YAML that hide what a file says.
#include "tests/io/settings_fixture.hpp"

#include <chrono>

using namespace settings_fixture;
using namespace std::string_literals;

TEST_CASE("files without settings") {
  const auto empty =
      "f.yaml:1:1: the file is empty; begin with 'scenario:' and the name of a scenario"s;
  for (const std::string text :
       {"", "\n\n", "# nothing\n", "---\n", "---\n...\n", "~\n", "\xEF\xBB\xBF"}) {
    CAPTURE(text);
    CHECK(error(text) == empty);
  }
  CHECK(error("just words\n")
        == "f.yaml:1:1: expected settings, got 'just words'; write lines such as 'scenario: "
           "periodic_tube'");
  CHECK(error("\n- scenario: tube\n").find("f.yaml:2:1: expected settings, got a list; ") == 0);
}

TEST_CASE("broken text") {
  CHECK(error("scenario: tube\nseed: \xFF\n")
        == "f.yaml:2:7: is not UTF-8; save the file as UTF-8");
  for (const std::string bytes : {"\xC0\xAF", "\xE2\x82", "\xED\xA0\x80", "\xF5\x80\x80\x80",
                                  "\x80", "\xE0\x80\x80", "\xF4\x90\x80\x80", "\xC3"}) {
    CHECK(error("a: ü" + bytes) == "f.yaml:1:5: is not UTF-8; save the file as UTF-8");
  }
  CHECK(error("s\0cenario: tube"s)
        == "f.yaml:1:2: control character 0x00; remove it, or check that this is a text file");
  CHECK(error("a: 1\rb: 2").find("f.yaml:1:5: control character 0x0D; ") == 0);
  CHECK(error("a: \x7F").find("f.yaml:1:4: control character 0x7F; ") == 0);
  CHECK(error("\xFF\xFE"
              "a\0:\0"s)
            .find("f.yaml:1:1: is not UTF-8; ")
        == 0);
  CHECK(error("run:\n\tthreads: 2\n")
        == "f.yaml:2:1: tab in the indentation; YAML is indented with spaces: replace it");
  CHECK(error("run:\n  \tthreads: 2\n").find("f.yaml:2:3: tab in the indentation; ") == 0);
  CHECK(error("scenario:\ttube\ncontact: {stiffness: 1}\ntube:  {width: 1} \t\n").empty());
  CHECK(error("a: " + std::string(1'000'000, 'x'))
        == "f.yaml: is larger than 1000000 bytes; a settings file is a page of YAML; check that "
           "this is "
           "the right file");
}

TEST_CASE("broken YAML") {
  const std::string remedy = "; check the colons, brackets, quotes and indentation up to here";
  CHECK(error("scenario: tube: wide\n")
        == "f.yaml:1:15: not valid YAML (illegal map value)" + remedy);
  CHECK(error("run: {threads: 2\n").find("f.yaml:2:1: not valid YAML (") == 0);
  CHECK(error("seed: @x\n") == "f.yaml:1:7: not valid YAML (unknown token)" + remedy);
  CHECK(error("seed: \"5\nrun: {}\n") == "f.yaml:1:7: this quote is never closed; close it");
  CHECK(error("seed: '5''\n") == "f.yaml:1:7: this quote is never closed; close it");
  CHECK(error("seed: \"5\\\"\n") == "f.yaml:1:7: this quote is never closed; close it");
  CHECK(error("\"seed: 5\n").find("f.yaml:1:1: ") == 0);
}

TEST_CASE("duplicate keys") {
  CHECK(error("seed: 1\nscenario: tube\nseed: 2\n")
        == "f.yaml:3:1: seed: is given twice, first at f.yaml:1:1; remove one of the two");
  CHECK(error("run: {threads: 1, stepping: auto, threads: 2}\n")
        == "f.yaml:1:35: run.threads: is given twice, first at f.yaml:1:7; remove one of the two");
  CHECK(error("run: {threads: 1}\nrun: {stepping: auto}\n").find("f.yaml:2:1: run: is given twice")
        == 0);
  CHECK(error("seed: 1\n\"seed\": 2\n").find("f.yaml:2:1: seed: is given twice") == 0);
}

TEST_CASE("several documents") {
  CHECK(error("scenario: tube\n---\nscenario: wall\n")
        == "f.yaml:2:1: a second document begins here; give each run a file of its own");
  CHECK(error("scenario: tube\n...\nscenario: wall\n").find("f.yaml:3:1: a second document") == 0);
  CHECK(error("scenario: tube\n---\n").find("f.yaml:2:1: a second document") == 0);
}

TEST_CASE("anchors, aliases, merge keys and tags") {
  CHECK(error("seed: &s 1\nrun: {threads: *s}\n")
        == "f.yaml:1:7: anchors (&name) are not supported; remove the anchor and write values out");
  CHECK(error("run: &r {threads: 1}\n").find("f.yaml:1:6: anchors (&name)") == 0);
  CHECK(error("seed: &s\n").find("anchors (&name)") != std::string::npos);
  CHECK(
      error("seed: *s\n").find("f.yaml:1:7: not valid YAML (the referenced anchor is not defined)")
      == 0);
  CHECK(error("run:\n  <<: {threads: 1}\n")
        == "f.yaml:2:3: merge keys (<<) are not supported; write the values out");
  CHECK(error("seed: !!int 5\n")
        == "f.yaml:1:7: tags such as 'tag:yaml.org,2002:int' are not supported; remove the tag");
  CHECK(error("run: !x {threads: 5}\n").find("f.yaml:1:6: tags such as '!x'") == 0);
}

TEST_CASE("keys that are no names") {
  CHECK(error("? [a, b]\n: 5\n")
        == "f.yaml:1:3: expected the name of a setting, got a list; write 'name: value'");
  CHECK(error(": 5\n").find("expected the name of a setting, got nothing") != std::string::npos);
  CHECK(error("run: {~: 5}\n").find("f.yaml:1:7: expected the name of a setting, got nothing")
        == 0);
  CHECK(error("{a: 1}: 5\n").find("f.yaml:1:1: expected the name of a setting, got a map") == 0);
}

TEST_CASE("nesting has a limit") {
  CHECK(error("a: [[[[[[[[[1]]]]]]]]]\n")
        == "f.yaml:1:11: nested more than 8 levels deep; reduce the nesting: above a key there "
           "are at most two levels of sections");
}

TEST_CASE("hostile files of the largest size are refused within seconds") {
  std::string many_keys;
  for (int i = 0; many_keys.size() < 900'000; ++i) many_keys += "k" + std::to_string(i) + ": 1\n";
  std::string many_words = "{";
  while (many_words.size() < 900'000) many_words += "ü,";
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& text :
       {std::string(900'000, '['), std::string(900'000, '{'), std::string(900'000, '-'),
        "scenario: " + std::string(900'000, '\''), many_keys, many_words,
        "a: &a [x]\nb: " + std::string(900'000, '*')}) {
    CHECK_FALSE(error(text).empty());
  }
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
}
