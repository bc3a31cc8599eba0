"""Numbers of Radau IIA with three stages, all from its nodes (Hairer, Wanner 1996, "Solving Ordinary Differential Equations II", §IV.5
and §IV.8).

Collocation: u(t + θ h) = y + Σ d_k θ^k, k = 1 … 3, with u̇ = f at the nodes c_i. With Z_i = u(t + c_i h) - y the equations Z = h A F
become three that are coupled through f alone by the left eigenvectors p of A⁻¹, μ its eigenvalues, ω = p Z:

    (1 - (h/μ) ∂f/∂y) Δω = (h/μ) p F - ω

one real, μ = γ, and a pair of complex ones, of which one is enough: Z = right ω₁ + 2 Re(right_pair ω₂).
"""

import numpy as np

C = np.array([(4.0 - np.sqrt(6.0)) / 10.0, (4.0 + np.sqrt(6.0)) / 10.0, 1.0])

_powers = np.arange(3)
A = np.ascontiguousarray((C[:, None] ** (_powers + 1) / (_powers + 1)) @ np.linalg.inv(C[:, None] ** _powers))
AA = np.ascontiguousarray(A @ A)
_eigenvalues, _right = np.linalg.eig(np.linalg.inv(A))
_mu = _eigenvalues.tolist()
_real, _pair = min(range(3), key=lambda k: abs(_mu[k].imag)), max(range(3), key=lambda k: _mu[k].imag)
# eigenvectors of which the last entry, that of the end of the step, is 1
_vectors = np.stack([_right[:, _real], _right[:, _pair], _right[:, _pair].conj()], axis=1)
_vectors = _vectors / _vectors[2]
_left = np.linalg.inv(_vectors)

GAMMA, MU = float(_mu[_real].real), complex(_mu[_pair])
RIGHT, RIGHT_PAIR = np.ascontiguousarray(_vectors[:, 0].real), np.ascontiguousarray(_vectors[:, 1])
LEFT, LEFT_PAIR = np.ascontiguousarray(_left[0].real), np.ascontiguousarray(_left[1])
# d_k = Σ COLLOCATION[k - 1, i] Z_i
COLLOCATION = np.linalg.inv(C[:, None] ** (_powers + 1))
# The collocation polynomial misses the solution inside a step by h⁴ times the integral of Π (θ - c_i), which is zero at both ends (ibid.
# II.7 of the first volume). Its coefficients of θ … θ⁴, for a slope of 1 at θ = 0:
_bend = np.polyint(np.poly(C))[::-1][1:]
BEND = np.ascontiguousarray(_bend / _bend[0])
