%% Persamaan Gerak
% State vector: Y = [theta1, omega1, theta2, omega2]

function dYdt = doublePendulum(~, Y, p)
    th1 = Y(1); w1 = Y(2);
    th2 = Y(3); w2 = Y(4);

    m1 = p.m1; m2 = p.m2;
    L1 = p.L1; L2 = p.L2;
    g = p.g;

    delta = th2 - th1;

    den1 = (m1 + m2)*L1 - m2*L1*cos(delta)*cos(delta);
    den2 = (L2/L1)*den1;

    dYdt = zeros(4, 1);
    dYdt(1) = w1;
    dYdt(2) = (m2*L1*w1^2*sin(delta)*cos(delta) + ...
               m2*g*sin(th2)*cos(delta) + ...
               m2*L2*w2^2*sin(delta) - ...
               (m1+m2)*g*sin(th1)) / den1;
    dYdt(3) = w2;
    dYdt(4) = (-m2*L2*w2^2*sin(delta)*cos(delta) + ...
               (m1+m2)*(g*sin(th1)*cos(delta) - ...
               L1*w1^2*sin(delta) - g*sin(th2))) / den2;
end
