"""The FiPy solvers on problems whose solutions are known: errors, orders, conservation, limits."""
