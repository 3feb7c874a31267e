function dx = cartpole_nonlinear_practical(x, u, p)
% x = [theta; theta_dot; x_c; x_c_dot]
% theta = 0 is upright.

theta    = x(1);
thetaDot = x(2);
xcDot    = x(4);

M = p.M;
m = p.m;
l = p.l;
g = p.g;

% Net force after cart friction
F = u - p.bCart*xcDot;

den = M + m*sin(theta)^2;

thetaDDot = ((M+m)*g*sin(theta) - cos(theta)*(F + m*l*thetaDot^2*sin(theta))) ...
            /(l*den);

xcDDot = (F + m*sin(theta)*(l*thetaDot^2 - g*cos(theta))) / den;

dx = [thetaDot;
      thetaDDot;
      xcDot;
      xcDDot];

end
