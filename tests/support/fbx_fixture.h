// A tiny skinned plant as FBX text, in any unit and up axis.
#pragma once

#include <QByteArray>

namespace windfall::test {

/// Two bones of 1 m one above the other and a mesh round them, written by a program whose unit is `centimetres` and
/// whose up axis is Y (1) or Z (2).
QByteArray fbxFixture(double centimetres, int upAxis);

}  // namespace windfall::test
