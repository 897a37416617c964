// A shell takes a word in quotes for what it is.
#include "io/shell_words.hpp"
#include "tests/catch.hpp"

using namespace riesel::io;

TEST_CASE("plain words need no quotes") {
  for (const char* word : {"riesel", "runs/tube-1_b", "run.duration=1e+3", "a:b,c@d%e"})
    CHECK(in_quotes(word) == word);
}

TEST_CASE("what means something to a shell, and nothing at all, stands in quotes") {
  CHECK(in_quotes("my runs/tube") == "'my runs/tube'");
  CHECK(in_quotes("$HOME/*") == "'$HOME/*'");
  CHECK(in_quotes("it's") == "'it'\\''s'");
  CHECK(in_quotes("") == "''");
}

TEST_CASE("a path is no option") {
  CHECK(path_argument("-x") == "./-x");
  CHECK(path_argument("--out = y/z") == "'./--out = y/z'");
  CHECK(path_argument("runs/-x") == "runs/-x");
}
