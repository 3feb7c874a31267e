function dx = cartpole_nonlinear(~, x, M, m, l, g)
    theta     = x(1);
    theta_dot = x(2);
    x_dot     = x(4);

    % No control force (free fall)
    u = 0;

    den = M + m*sin(theta)^2;

    theta_ddot = (g*sin(theta) - cos(theta)*(u + m*l*theta_dot^2*sin(theta))/den) / ...
                 (l*(4/3 - m*cos(theta)^2/den));
    x_ddot = (u + m*l*(theta_dot^2*sin(theta) - theta_ddot*cos(theta))) / den;

    dx = [theta_dot;
          theta_ddot;
          x_dot;
          x_ddot];
end
