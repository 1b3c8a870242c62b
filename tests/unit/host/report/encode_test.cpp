#include "host/report/encode.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

std::vector<uint8_t> bytesOf(const std::string &text) { return {text.begin(), text.end()}; }

TEST(Base64, MatchesRfc4648) {
  EXPECT_EQ(base64(bytesOf("")), "");
  EXPECT_EQ(base64(bytesOf("f")), "Zg==");
  EXPECT_EQ(base64(bytesOf("fo")), "Zm8=");
  EXPECT_EQ(base64(bytesOf("foo")), "Zm9v");
  EXPECT_EQ(base64(bytesOf("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64({0xFB, 0xFF}), "+/8=");
}

TEST(EscapeHtml, LeavesNoMarkup) { EXPECT_EQ(escapeHtml("<a b='c'>&\""), "&lt;a b=&#39;c&#39;&gt;&amp;&quot;"); }

TEST(InlineSvg, MakesIdsUniqueAndCutsTheDeclaration) {
  const std::string svg =
      "<?xml?><svg><path id='a'/><use xlink:href='#a' clip-path=\"url(#b)\"/><g id=\"b\"/></svg>";
  EXPECT_EQ(inlineSvg(svg, "p-"),
            "<svg><path id='p-a'/><use xlink:href='#p-a' clip-path=\"url(#p-b)\"/><g id=\"p-b\"/></svg>");
}

}  // namespace
}  // namespace sphc::host
