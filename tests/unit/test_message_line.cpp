#include <doctest/doctest.h>

#include "io/text/message_line.hpp"

using namespace breccia;

TEST_CASE("A long text is shortened between words, and never within a character") {
  CHECK(shortened("short", 5) == "short");
  CHECK(shortened("some words that go on", 13) == "some words...");
  CHECK(shortened("some words that go on", 14) == "some words...");
  CHECK(shortened("some words that go on", 15) == "some words that...");
  CHECK(shortened("a wordwithoutend", 10) == "a wordwith...");  // the blank is too far back
  CHECK(shortened("\u00e4\u00e4\u00e4\u00e4", 5) == "\u00e4\u00e4...");
  CHECK(shortened("\xff\xff\xff\xff", 3) == "\xff\xff\xff...");
}

TEST_CASE("What is no UTF-8 is shown as numbers") {
  CHECK(printable("plain \u00e4 \u20ac \U0001f600") == "plain \u00e4 \u20ac \U0001f600");
  CHECK(printable("bad\xff") == "bad\\xff");
  CHECK(printable("cut \xe2\x82") == "cut \\xe2\\x82");
  CHECK(printable("\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80") ==
        "\\xc0\\xaf \\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80");
  CHECK(is_utf8("\u20ac"));
  CHECK_FALSE(is_utf8("\x80"));
  CHECK_FALSE(is_utf8("\xf8\x88\x80\x80\x80"));
}

TEST_CASE("A message is one line, and no word of it fills a screen") {
  CHECK(message_line("two\nlines\r\t\x1b[31m") == "two lines   [31m");
  const std::string word(1000, 'w'), path = "/begin" + std::string(500, '/') + "end.csv:7:";
  const std::string line = message_line("key " + word + ": " + path + " is wrong");
  CHECK(line.size() < 550);
  CHECK(line.starts_with("key www"));
  CHECK(line.find("www...www") != std::string::npos);
  CHECK(line.ends_with("end.csv:7: is wrong"));
  CHECK(message_line(std::string(300, 'w')) == std::string(300, 'w'));
}
