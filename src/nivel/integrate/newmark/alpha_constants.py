"""Constants of Newmark's method and of its two families with damping of high frequencies. Imports no kernel.

    (1 - α_m) a₁ + α_m a₀ = (1 - α_f) v̇₁ + α_f v̇₀        q₁ = q₀ + h v₀ + h² ((½ - β) a₀ + β a₁)        v₁ = v₀ + h ((1 - γ) a₀ + γ a₁)

for the accelerations; (1 - δ_m) w₁ + δ_m w₀ = (1 - δ_f) ẋ₁ + δ_f ẋ₀, x₁ = x₀ + h ((1 - θ) w₀ + θ w₁) for first-order states
(Jansen, Whiting, Hulbert 2000; Brüls, Golinval 2006). Newmark 1959; HHT-α: Hilber, Hughes, Taylor 1977; generalised-α: Chung, Hulbert
1993, in the form of Arnold, Brüls 2007, in which all forces and constraints are those of the end of the step.
"""

Constants = tuple[float, ...]
# ρ∞ where none is given. The formulas put what bends in a step, h² q⃛, into the speed of a stiff spring that turns. At infinite frequency
# ρ∞ is a threefold eigenvalue, so what one step leaves there grows before it decays; where every other step is of another length, it must
# decay sooner.
FIXED_STEPS, CHOSEN_STEPS = 0.8, 0.6


def newmark(beta: float, gamma: float) -> Constants:
    """(α_m, α_f, β, γ, δ_m, δ_f, θ); order 2 with γ = ½."""
    return 0.0, 0.0, beta, gamma, 0.0, 0.0, gamma


def hht(alpha: float) -> Constants:
    """For 0 ≤ α ≤ ⅓, order 2; 0 is Newmark's method with β = ¼, γ = ½."""
    return 0.0, alpha, 0.25 * (1.0 + alpha) ** 2, 0.5 + alpha, 0.0, alpha, 0.5 + alpha


def generalised_alpha(spectral_radius: float) -> Constants:
    """For ρ∞ from 0 (frequencies above the step vanish in one step) to 1 (none is damped), order 2."""
    rho = spectral_radius
    alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
    gamma = 0.5 - alpha_m + alpha_f
    beta = 0.25 * (gamma + 0.5) ** 2
    delta_m = 0.5 * (3.0 * rho - 1.0) / (rho + 1.0)
    return alpha_m, alpha_f, beta, gamma, delta_m, alpha_f, 1.0 / (rho + 1.0)
