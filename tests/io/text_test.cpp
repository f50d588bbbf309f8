#include "renderengine/io/text.h"

#include <gtest/gtest.h>

#include "renderengine/error.h"

using namespace antipode;

TEST(ReadableText, TellsUtf8FromOtherBytes) {
    for (const std::string good : {"", "plain", "\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                                   "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
        EXPECT_TRUE(isUtf8(good)) << good;
    for (const std::string bad : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
                                  "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "\xC3", "\xE2\x82", "\xF0\x9F\x98"})
        EXPECT_FALSE(isUtf8(bad)) << bad;
}

TEST(ReadableText, TakesOtherBytesForLatin1) { EXPECT_EQ(readableText("M\xFCll"), "M\xC3\xBCll"); }

TEST(ReadableText, HasNoControlCharacters) { EXPECT_EQ(readableText("a\x1b[31m\nb\x7f"), "a?[31m?b?"); }

TEST(ReadableText, IsCutBetweenCharacters) {
    EXPECT_EQ(readableText("12345", 5), "12345");
    EXPECT_EQ(readableText("123456", 5), "12345…");
    EXPECT_EQ(readableText("1234\xC3\xBC", 5), "1234…");
}

TEST(Hexadecimal, GivesTwoLowerCaseDigitsAByte) {
    EXPECT_EQ(hexadecimal(std::string("\x00\x0F\xF0\xFF", 4)), "000ff0ff");
    EXPECT_EQ(hexadecimal(""), "");
}

TEST(Hexadecimal, IsReadBack) {
    std::string bytes;
    for (int value = 0; value < 256; ++value) bytes.push_back(char(value));
    EXPECT_EQ(fromHexadecimal(hexadecimal(bytes)), bytes);
    EXPECT_EQ(fromHexadecimal("aBCd"), "\xAB\xCD");
}

TEST(Hexadecimal, RefusesWhatIsNoPairOfDigits) {
    for (const char* bad : {"0", "0g", "g0", "00 ", " 0", "-1", "+1", "0x", "123"})
        EXPECT_THROW(fromHexadecimal(bad), Error) << bad;
}
