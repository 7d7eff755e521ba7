// SPDX-License-Identifier: BSL-1.0
// Empty: the file for which the precompiled header of the tests is made.
