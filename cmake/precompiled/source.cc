// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// The one source of the libraries that hold precompiled headers.
